// Tools as bodies: rings about the tool axis, whose outlines on the screen are convex.

const FACETS = 28;
const SHARP = Math.cos(0.6);  // of the angle at a corner, from which on it is an edge of a body

// The parts of a tool from above: rings [radius, height above the tip], and which colour they have.
function parts(tool, extent, held = false) {
  const found = bare(tool, extent), holder = (held && tool.holder) || [], top = (tool.length || 0) + (tool.dl || 0);
  const rings = holder.map(([radius, from], k) => [[[radius, from], [radius, k + 1 < holder.length ? holder[k + 1][1] : Math.max(top, from + radius)]], "holder"]);
  if (rings.length) found[0][0][found[0][0].length - 1][1] = Math.max(found[0][0][found[0][0].length - 1][1], holder[0][1]);  // up to it
  return [...rings.reverse(), ...found];
}
function bare(tool, extent) {
  const radius = Math.abs((tool.radius || 0) + (tool.dr || 0)) || extent / 80;
  const cutting = tool.cutting_length || Math.max(6 * radius, extent / 12);
  const length = Math.max(Math.min(tool.length || 0, 3 * cutting), 1.7 * cutting);
  const corner = Math.min(tool.corner || 0, radius), kind = (tool.kind || "").toLowerCase();
  let part = [];
  if (kind.includes("probe")) {
    part = arcRings(radius, radius, Math.PI);
    return [[[[radius * 2, cutting], [radius * 2, length]], "shank"], [[[radius / 2, 1.8 * radius], [radius / 2, cutting]], "shank"], [part, "cutter"]];
  }
  if (tool.angle > 0 && tool.angle < 180) part = [[0, 0], [radius, radius / Math.tan(tool.angle * Math.PI / 360)]];
  else if (kind.includes("ball") || (corner > 0 && corner >= radius)) part = arcRings(radius, radius, Math.PI / 2);
  else if (corner > 0) part = arcRings(radius, corner, Math.PI / 2);
  else part = [[radius, 0]];
  const top = Math.max(cutting, part[part.length - 1][1]);
  return [[[[radius, top], [radius, Math.max(length, top * 1.2)]], "shank"], [[...part, [radius, top]], "cutter"]];
}

// A corner of a radius at the foot of a body of revolution, from the middle outwards.
function arcRings(radius, corner, angle) {
  const found = [];
  for (let k = 0; k <= 6; k++) {
    const a = angle * k / 6;
    found.push([radius - corner + corner * Math.sin(a), corner * (1 - Math.cos(a))]);
  }
  return found;
}

// The smallest convex outline of points [x, y], counter-clockwise (Andrew's monotone chain).
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = list => {
    const kept = [];
    for (const p of list) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(p);
    }
    return kept.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...half(sorted), ...half(sorted.reverse())];
}

// A circle of a tool along X, Y or Z (0, 1, 2).
function ring([radius, height], tip, along, project) {
  const found = [];
  for (let k = 0; k < FACETS; k++) {
    const a = 2 * Math.PI * k / FACETS, at = tip.slice();
    at[(along + 1) % 3] += radius * Math.cos(a);
    at[(along + 2) % 3] += radius * Math.sin(a);
    at[along] += height;
    found.push(project(at));
  }
  return found;
}

function trace(pen, points) {
  pen.beginPath();
  points.forEach(([x, y], k) => k ? pen.lineTo(x, y) : pen.moveTo(x, y));
  pen.closePath();
}

// A mill, drill or probe with its tip at a point, and its shank along X, Y or Z (0, 1, 2).
function drawTool(pen, tool, tip, along, project, colours, extent, held) {
  for (const [part, colour] of parts(tool, extent, held)) {
    const all = part.map(each => ring(each, tip, along, project));
    trace(pen, hull(all.flat()));
    pen.fillStyle = colours[colour];
    pen.strokeStyle = colours.edge;
    pen.lineWidth = 1.2;
    pen.fill();
    pen.stroke();
    trace(pen, all[all.length - 1]);
    pen.lineWidth = 0.7;
    pen.stroke();
  }
}

// The insert of a lathe tool and its holder: name, corners (z, r) about the tip, and how thick they are to both sides of the plane
// of X and Z.
function blades({insert, holder}) {
  const size = Math.max(...[0, 1].map(k => Math.max(...insert.map(each => each[k])) - Math.min(...insert.map(each => each[k]))));
  return [["holder", holder, 0.3 * size], ["insert", insert, 0.16 * size]];
}

// Both are like glass.
function drawInsert(pen, held, tip, project, colours) {
  for (const [name, corners, thick] of blades(held)) {
    const faces = [-thick, thick].map(y => corners.map(([z, r]) => project([tip[0] + r, tip[1] + y, tip[2] + z]))), [back, front] = faces;
    const sides = front.map((corner, k) => [corner, back[k], ...[back, front].map(face => face[(k + 1) % face.length])]);
    pen.fillStyle = colours[name];
    pen.strokeStyle = colours.edge;
    pen.lineWidth = name === "insert" ? 1.2 : 0.7;
    pen.lineJoin = "round";
    const whole = new Path2D(), edges = new Path2D();
    corners.forEach(([z, r], k) => {
      const [[az, ar], [bz, br]] = [corners.at(k - 1), corners[(k + 1) % corners.length]], [u, v] = [[z - az, r - ar], [bz - z, br - r]];
      if (u[0] * v[0] + u[1] * v[1] > SHARP * Math.hypot(...u) * Math.hypot(...v)) return;
      edges.moveTo(...back[k]);
      edges.lineTo(...front[k]);
    });
    for (const face of [...faces, ...sides]) {  // all one way round: so what lies over one another is filled once
      const area = face.reduce((sum, [x, y], k) => sum + x * face[(k + 1) % face.length][1] - y * face[(k + 1) % face.length][0], 0);
      (area < 0 ? face.reverse() : face).forEach(([x, y], k) => whole[k ? "lineTo" : "moveTo"](x, y));
      whole.closePath();
    }
    pen.fill(whole);
    pen.stroke(edges);
    for (const face of faces) {
      trace(pen, face);
      pen.stroke();
    }
  }
}
