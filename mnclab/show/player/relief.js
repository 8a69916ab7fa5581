// The part as a shaded relief (WebGL 2): one vertex for each cell, whose place comes from textures: those beside a wall stand on
// it (see walls.js). Only tiles that changed are sent. Round the map runs a skirt down to the lower side of the blank.

const RAW = 0, DONE = 1, NOW = 2, WOUND = -1;  // what has cut a cell: a move done, the one going on, a rapid in material
const GONE = 8;  // more, where nothing is left
const BLOCK = 4;  // cells of a square that is drawn as one, where it is level
const ROUGH = 0, SMOOTH = 1, LEVEL = 2;
const SIDES = 4;  // vertices that a row or a column of cells has more: below and above at both ends

const VERTEX = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D cut;  // height, what has cut (RAW to GONE), and the slopes
uniform sampler2D floors;
uniform sampler2D moved;  // onto a wall, mm
uniform ivec2 cells;
uniform vec4 edges;  // least x and y, greatest x and y
uniform float cell;
uniform vec3 right, up, near, target;
uniform vec3 size;  // half of the picture in mm, and of its depth
uniform bool below;
out vec3 seen;
out vec4 state;  // whether something is left, height, what has cut, 1 at the rim of the blank and 2 at the foot of its side
out vec3 rise;  // slopes, and whether a rapid has cut
void main() {
  int wide = cells.x + ${SIDES};
  ivec2 v = ivec2(gl_VertexID % wide, gl_VertexID / wide), at = clamp(v - 2, ivec2(0), cells - 1);
  vec4 h = texelFetch(cut, at, 0);
  vec2 middle = edges.xy + cell * (vec2(at) + 0.5) + texelFetch(moved, at, 0).xy;
  vec2 xy = vec2(v.x < 2 ? edges.x : v.x >= cells.x + 2 ? edges.z : min(middle.x, edges.z),
    v.y < 2 ? edges.y : v.y >= cells.y + 2 ? edges.w : min(middle.y, edges.w));
  bool skirt = v.x == 0 || v.y == 0 || v.x == cells.x + 3 || v.y == cells.y + 3;
  vec3 place = vec3(xy, skirt || below ? texelFetch(floors, at, 0).r : h.x) - target;
  seen = vec3(dot(place, right), dot(place, up), dot(place, near));
  bool gone = h.y > float(${GONE - 2});
  float by = gone ? h.y - float(${GONE}) : h.y;
  state = vec4(gone ? 0.0 : 1.0, h.x, abs(by), skirt ? 2.0 : any(lessThan(v, ivec2(2))) || any(greaterThanEqual(v, cells + 2)) ? 1.0 : 0.0);
  rise = vec3(h.zw, by < 0.0 ? 1.0 : 0.0);
  gl_Position = vec4(seen.xy / size.xy, -seen.z / size.z, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 blank, metal, deep, red, fresh;
uniform vec2 depths;  // lowest and highest place of the blank
in vec3 seen;
in vec4 state;
in vec3 rise;
uniform vec3 right, up, near;
uniform bool below;
out vec4 colour;
bool below_is(float share) {  // a wall is what the cell at its foot is
  vec2 slope = vec2(dFdx(share), dFdy(share)), climb = vec2(dFdx(state.y), dFdy(state.y));
  return share > 0.98 || (share > 0.02 && dot(slope, climb) < 0.0);
}
void main() {
  if (state.x < 0.01) discard;
  vec3 across = normalize(cross(dFdx(seen), dFdy(seen)));
  if (across.z < 0.0) across = -across;
  vec3 round = normalize(vec3(-rise.xy, 1.0));
  float upright = 1.0 - smoothstep(0.08, 0.25, abs(dot(across, vec3(right.z, up.z, near.z))));
  if (!below) across = normalize(mix(vec3(dot(round, right), dot(round, up), dot(round, near)), across, min(max(upright, state.w), 1.0)));
  float light = 0.5 + 0.5 * dot(across, normalize(vec3(-0.45, 0.6, 0.9)));
  float shine = pow(max(dot(across, normalize(vec3(-0.25, 0.33, 1.6))), 0.0), 40.0);
  float depth = clamp((depths.y - state.y) / max(depths.y - depths.x, 1e-6), 0.0, 1.0);
  vec3 tone = below_is(rise.z) ? red : mix(mix(metal, deep, sqrt(depth)), fresh, 0.55 * clamp(state.z - 1.0, 0.0, 1.0));
  if (below || state.w > 1.001 || !below_is(min(state.z, 1.0))) tone = blank;
  colour = vec4(tone * (0.42 + 0.62 * light * light) + 0.06 * shine, 1.0);
}`;

class Relief {
  constructor(canvas, carving, picture) {
    Object.assign(this, {canvas, picture, run: carving.run});
    this.grid = carving.grid;
    this.depths = carving.depths;
    this.sent = [];  // the tiles that the texture holds
    this.patch = new Patch(picture);
    this.slow = drawnByProcessor();  // then only what changed is drawn, and smooth edges cost too much
    this.gl = canvas.getContext("webgl2", {antialias: !this.slow, preserveDrawingBuffer: this.slow});
    if (!this.gl) return;
    canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
    this.prepare();
  }
  prepare() {
    const {gl, grid} = this;
    this.shading = program(gl, VERTEX, FRAGMENT);
    this.place = this.shading.place;
    this.shading.use();
    this.beside = new Beside(gl, this.run, this.picture);
    this.shading.use();
    this.mesh();
    this.texture(0, "cut", gl.RGBA32F);
    this.texture(2, "moved", gl.RG32F);
    this.texture(1, "floors", gl.R32F);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, grid.nx, grid.ny, gl.RED, gl.FLOAT, Float32Array.from(grid.floor));
    gl.enable(gl.DEPTH_TEST);
    this.sent = [];
    this.state = "";  // of which picture it is, in which size
  }
  // A buffer for the triangles of each tile: to change some of a common one, all of it would be copied while it is drawn.
  mesh() {
    const {gl, grid} = this;
    this.faces = Array.from({length: grid.across * grid.up}, () => gl.createBuffer());
    this.counts = this.faces.map(() => 0);
    this.rims = [];  // of each tile, the upper edges of its walls
    this.blocks = Math.ceil(grid.nx / BLOCK);
    this.even = new Uint8Array(this.blocks * Math.ceil(grid.ny / BLOCK));
    this.index = new Uint32Array(6 * (TILE + 4) ** 2);
  }
  // Whether the cells of a block and those that follow it have no wall and are alike, and level as well.
  evenness(map, i0, j0, row) {
    const {grid} = this, own = map.height(i0, j0), kind = this.kind(map, i0, j0, row);
    if (i0 + BLOCK >= grid.nx || j0 + BLOCK >= grid.ny) return ROUGH;
    let even = LEVEL;
    for (let j = j0; j <= j0 + BLOCK; j++)
      for (let i = i0; i <= i0 + BLOCK; i++) {
        if (this.kind(map, i, j, row) !== kind) return ROUGH;
        if (!map.open(i, j) && (map.walled(i, j, 1, 0) || map.walled(i, j, -1, 0) || map.walled(i, j, 0, 1) || map.walled(i, j, 0, -1))) return ROUGH;
        if (Math.abs(map.height(i, j) - own) > SAME) even = SMOOTH;
      }
    return even;
  }
  kind(map, i, j, row) {
    const {grid} = this, tile = map.tiles[(j >> 5) * grid.across + (i >> 5)], at = (j & 31) * TILE + (i & 31), by = tile.by[at];
    return (tile.h[at] > grid.floor[j * grid.nx + i] ? 0 : GONE) + (by < 0 ? WOUND : by === 0 ? RAW : by === row + 1 ? NOW : DONE);
  }
  // The triangles of a tile: where a wall goes round one of four cells, the other three have one; a level block is one, so are
  // four cells of a smooth one where the processor draws. Its rim has all cells where its neighbour has.
  triangles(map, k) {
    const {gl, grid, even, blocks, slow, index} = this, wide = grid.nx + SIDES, rims = [], i0 = k % grid.across * TILE, j0 = (k / grid.across | 0) * TILE;
    const size = (i, j) => {
      const own = i < 0 || j < 0 || i >= grid.nx || j >= grid.ny ? ROUGH : even[(j / BLOCK | 0) * blocks + (i / BLOCK | 0)];
      return own === LEVEL ? BLOCK : own === SMOOTH && slow ? 2 : 1;
    };
    const ends = (start, n) => [start ? start : -2, start + TILE >= n ? n + 1 : start + TILE];
    const [[left, right], [low, high]] = [ends(i0, grid.nx), ends(j0, grid.ny)];
    let count = 0;
    const corner = (a, b, c) => { [index[count], index[count + 1], index[count + 2]] = [a, b, c]; count += 3; };
    for (let j = low; j < high; j++)
      for (let i = left; i < right; i++) {
        const a = (j + 2) * wide + i + 2, [b, c, d] = [a + 1, a + wide, a + wide + 1], n = size(i, j);
        if (n > 1) {
          if (i % n || j % n) continue;
          const rim = [], side = (from, step, other) => { for (let at = 0; at < n; at += other === n ? n : 1) rim.push(from + at * step); };
          side(a, 1, size(i, j - 1));
          side(a + n, wide, size(i + n, j));
          side(a + n * (wide + 1), -1, size(i, j + n));
          side(a + n * wide, -wide, size(i - 1, j));
          const middle = rim.length > 4 ? a + n / 2 * (wide + 1) : rim.pop();
          rim.forEach((v, at) => rim.length === 3 && at === 2 || corner(middle, v, rim[(at + 1) % rim.length]));
          continue;
        }
        const inner = i >= 0 && j >= 0 && i + 1 < grid.nx && j + 1 < grid.ny;
        const walled = inner && !(map.open(i, j) && map.open(i + 1, j + 1));
        if (!walled) {
          if ((i + j) & 1) { corner(a, b, c); corner(c, b, d); } else { corner(a, b, d); corner(a, d, c); }
          continue;
        }
        const [south, west] = inner ? [map.walled(i, j, 1, 0), map.walled(i, j, 0, 1)] : [0, 0];
        const [north, east] = inner ? [map.walled(i, j + 1, 1, 0), map.walled(i + 1, j, 0, 1)] : [0, 0];
        const alone = !(south || west || north || east) || (south && north) || (west && east) ? (i + j) & 1 : Boolean(south) === Boolean(west);
        if (alone) { corner(a, b, c); corner(c, b, d); } else { corner(a, b, d); corner(a, d, c); }
        const walls = [[south, 0, 1], [west, 0, 2], [north, 2, 3], [east, 1, 3]].filter(([wall]) => wall), cell = n => [i + (n & 1), j + (n >> 1)];
        const high = new Set(walls.map(([, one, other]) => map.height(...cell(one)) > map.height(...cell(other)) ? one : other));
        if (high.size === 2) high.forEach(n => {
          const [x, y] = cell(n), [dx, dy, z] = map.moved(x, y);
          rims.push(grid.x(x) + dx, grid.y(y) + dy, z);
        });
      }
    if (rims.length || this.rims[k]) this.rims[k] = this.beside.space.wire(Float32Array.from(rims), Uint8Array.from({length: rims.length / 3}, (_, n) => n % 2), this.rims[k]);
    gl.bindVertexArray(null);
    this.counts[k] = count;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.faces[k]);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index.subarray(0, count), gl.DYNAMIC_DRAW);
  }
  texture(unit, name, format) {
    const {gl, grid} = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, grid.nx, grid.ny);
    for (const what of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, what, gl.NEAREST);
    gl.uniform1i(this.place[name], unit);
  }
  // Send the cells that are not as before, and their neighbours, whose slopes change with them; and those of the row going on.
  send(map, row) {
    const {gl, grid, patch} = this, cells = this.cells ||= new Float32Array(4 * TILE * TILE), moved = this.moved ||= new Float32Array(2 * TILE * TILE);
    const marks = row === this.row ? [] : [this.row, row].filter(each => each >= 0).map(each => each + 1), blocks = new Set();
    const changed = map.changed(this.sent, marks), tiles = new Set(changed.keys()), {nx, ny} = grid;
    this.row = row;
    for (const [k, [i0, j0, i1, j1]] of changed) {
      let at = 0, to = 0;
      for (let j = j0; j <= j1; j++)
        for (let i = i0; i <= i1; i++) {
          const [x, y, z, dx, dy] = map.moved(i, j);
          cells[at++] = z;
          cells[at++] = this.kind(map, i, j, row);
          cells[at++] = dx;
          cells[at++] = dy;
          moved[to++] = x;
          moved[to++] = y;
        }
      gl.activeTexture(gl.TEXTURE0);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, i0, j0, i1 - i0 + 1, j1 - j0 + 1, gl.RGBA, gl.FLOAT, cells.subarray(0, at));
      gl.activeTexture(gl.TEXTURE2);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, i0, j0, i1 - i0 + 1, j1 - j0 + 1, gl.RG, gl.FLOAT, moved.subarray(0, to));
      const [first, last, low, high] = [Math.max(i0 - BLOCK - 1, 0), Math.min(i1 + 1, nx - 1), Math.max(j0 - BLOCK - 1, 0), Math.min(j1 + 1, ny - 1)].map(n => n / BLOCK | 0);
      for (let j = low; j <= high; j++)
        for (let i = first; i <= last; i++) blocks.add(j * this.blocks + i);
      patch.addBox([grid.x(i0 - BLOCK), grid.y(j0 - BLOCK), this.depths[0]], [grid.x(i1 + BLOCK), grid.y(j1 + BLOCK), this.depths[1]]);
    }
    for (const n of blocks) {
      const i = n % this.blocks * BLOCK, j = (n / this.blocks | 0) * BLOCK, even = this.evenness(map, i, j, row);
      if (even === this.even[n]) continue;
      this.even[n] = even;
      for (const y of [Math.max(j - 1, 0), Math.min(j + BLOCK, ny - 1)])
        for (const x of [Math.max(i - 1, 0), Math.min(i + BLOCK, nx - 1)]) tiles.add((y >> 5) * grid.across + (x >> 5));
    }
    for (const k of tiles) this.triangles(map, k);
  }
  // The tiles that are drawn anew.
  seen() {
    const {grid: {across, step, low, high}, depths, patch} = this;
    return this.counts.map((_, k) => k).filter(k => {
      const [x, y] = [low[0] + k % across * TILE * step, low[1] + (k / across | 0) * TILE * step];
      return patch.meets([x - step, y - step, depths[0]], [Math.min(x + (TILE + 1) * step, high[0]), Math.min(y + (TILE + 1) * step, high[1]), depths[1]]);
    });
  }
  draw(camera, colours, map, row, ratio, turning = false) {
    const {gl, grid, place, beside, patch} = this, [w, h] = camera.size, [low, high] = this.depths, {width, height} = this.canvas;
    const state = [this.picture.version, width, height, turning].join();
    patch.begin(!this.slow || state !== this.state, this.slow && turning);
    this.state = state;
    this.shading.use();
    this.send(map, row);
    beside.changed(patch);
    if (patch.empty) return;
    patch.clip(gl, this.canvas);
    const seen = this.seen();
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const far = [...grid.low, low].reduce((sum, v, k) => sum + Math.abs(v - camera.target[k]), 0)
      + [...grid.high, high].reduce((sum, v, k) => sum + Math.abs(v - camera.target[k]), 0) + beside.far(camera);
    gl.disable(gl.BLEND);
    gl.uniform2i(place.cells, grid.nx, grid.ny);
    gl.uniform4f(place.edges, ...grid.low, ...grid.high);
    gl.uniform1f(place.cell, grid.step);
    for (const name of ["right", "up", "near", "target"]) gl.uniform3f(place[name], ...camera[name]);
    gl.uniform3f(place.size, w / 2 / camera.zoom, h / 2 / camera.zoom, far || 1);
    gl.uniform2f(place.depths, low, high);
    for (const [name, colour] of [["blank", "raw"], ["metal", "metal"], ["deep", "deep"], ["red", "crash"], ["fresh", "now"]])
      gl.uniform3f(place[name], ...rgb(colours[colour]));
    for (const below of camera.near[2] < 0 ? [0, 1] : [0]) {
      gl.uniform1i(place.below, below);
      for (const k of seen) {
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.faces[k]);
        gl.drawElements(gl.TRIANGLES, this.counts[k], gl.UNSIGNED_INT, 0);
      }
    }
    beside.space.look(camera, far, ratio);
    for (const rim of seen.map(k => this.rims[k])) if (rim) beside.space.stroke(rim, 0, rim.count, [null, [colours.edge]], 1.1, 0.85);
    beside.draw(patch);
  }
}
