// What a probe touched so far: a dot at each place, and its number and value where there is room for them.

const WRITTEN = 80;  // touches that are written beside

class Touches {
  constructor(run) {
    this.all = run.header.felt.touches;
  }
  // `taken` are the boxes of what is written already; `sees` says of a place whether metal hides it.
  draw(pen, camera, colours, rowsDone, taken = [], sees = () => true) {
    const done = this.all.filter(({row, from}) => row < rowsDone && sees(from)), places = done.map(({at}) => camera.project(at));
    pen.fillStyle = colours.probing;
    pen.strokeStyle = colours.paper;
    pen.lineWidth = 1;
    for (const [x, y] of places) {
      pen.beginPath();
      pen.arc(x, y, 3.4, 0, 7);
      pen.fill();
      pen.stroke();
    }
    if (done.length > WRITTEN) return;
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    done.forEach(({text}, k) => {
      const wide = pen.measureText(text).width, [x, y] = places[k];
      for (const [dx, dy] of [[8, -9], [8, 9], [-8 - wide, -9], [-8 - wide, 9], [8, -22], [8, 22], [-8 - wide, -22], [-8 - wide, 22]]) {
        const box = [x + dx - 3, y + dy - 7, x + dx + wide + 3, y + dy + 7];
        const over = other => box[0] < other[2] && box[2] > other[0] && box[1] < other[3] && box[3] > other[1];
        if (taken.some(over) || places.some(([a, b], i) => i !== k && over([a - 3, b - 3, a + 3, b + 3]))) continue;
        taken.push(box);
        pen.lineWidth = 4;
        pen.lineJoin = "round";
        pen.strokeText(text, x + dx, y + dy);
        pen.fillText(text, x + dx, y + dy);
        break;
      }
    });
  }
}
