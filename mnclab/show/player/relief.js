// The part as a shaded relief (WebGL 2): one vertex for each cell, whose height comes from a texture. Only tiles that changed
// are sent. Round the map runs a skirt down to the lower side of the blank.

const GONE = 1e9;
const SIDES = 4;  // vertices that a row or a column of cells has more: below and above at both ends

const VERTEX = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D cut;  // height, the row that cut + 1 (negative: a rapid; GONE: nothing is left), and the slopes
uniform sampler2D floors;
uniform ivec2 cells;
uniform vec4 edges;  // least x and y, greatest x and y
uniform float cell;
uniform vec3 right, up, near, target;
uniform vec3 size;  // half of the picture in mm, and of its depth
uniform bool below;
out vec3 seen;
out vec4 state;  // whether something is left, height, row, at the side of the blank
out vec2 rise;
void main() {
  int wide = cells.x + ${SIDES};
  ivec2 v = ivec2(gl_VertexID % wide, gl_VertexID / wide), at = clamp(v - 2, ivec2(0), cells - 1);
  vec4 h = texelFetch(cut, at, 0);
  vec2 middle = edges.xy + cell * (vec2(at) + 0.5);
  vec2 xy = vec2(v.x < 2 ? edges.x : v.x >= cells.x + 2 ? edges.z : min(middle.x, edges.z),
    v.y < 2 ? edges.y : v.y >= cells.y + 2 ? edges.w : min(middle.y, edges.w));
  bool skirt = v.x == 0 || v.y == 0 || v.x == cells.x + 3 || v.y == cells.y + 3;
  vec3 place = vec3(xy, skirt || below ? texelFetch(floors, at, 0).r : h.x) - target;
  seen = vec3(dot(place, right), dot(place, up), dot(place, near));
  state = vec4(h.y < float(${GONE}) ? 1.0 : 0.0, h.x, h.y, any(lessThan(v, ivec2(2))) || any(greaterThanEqual(v, cells + 2)) ? 1.0 : 0.0);
  rise = h.zw;
  gl_Position = vec4(seen.xy / size.xy, -seen.z / size.z, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 blank, metal, deep, red, fresh;
uniform vec2 depths;  // lowest and highest place of the blank
uniform float now;  // the row going on + 1
in vec3 seen;
in vec4 state;
in vec2 rise;
uniform vec3 right, up, near;
uniform bool below;
out vec4 colour;
void main() {
  if (state.x < 0.01) discard;
  vec3 across = normalize(cross(dFdx(seen), dFdy(seen)));
  if (across.z < 0.0) across = -across;
  vec3 round = normalize(vec3(-rise, 1.0));
  if (!below) across = normalize(mix(vec3(dot(round, right), dot(round, up), dot(round, near)), across, 0.25 + 0.75 * state.w));
  float light = 0.5 + 0.5 * dot(across, normalize(vec3(-0.45, 0.6, 0.9)));
  float shine = pow(max(dot(across, normalize(vec3(-0.25, 0.33, 1.6))), 0.0), 40.0);
  float depth = clamp((depths.y - state.y) / max(depths.y - depths.x, 1e-6), 0.0, 1.0);
  float row = floor(abs(state.z) + 0.5);
  vec3 tone = row < 0.5 ? blank : mix(metal, deep, sqrt(depth));
  if (row > 0.5 && row == now) tone = mix(tone, fresh, 0.55);
  if (state.z < -0.5) tone = red;
  colour = vec4(tone * (0.42 + 0.62 * light * light) + 0.06 * shine, 1.0);
}`;

class Relief {
  constructor(canvas, carving) {
    this.canvas = canvas;
    this.grid = carving.grid;
    this.depths = carving.depths;
    this.sent = [];  // the tiles that the texture holds
    this.uploads = 0;
    this.slow = drawnByProcessor();  // then every second cell must do while something moves, and smooth edges cost too much
    this.gl = canvas.getContext("webgl2", {antialias: !this.slow, premultipliedAlpha: false});
    if (!this.gl) return;
    canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
    this.prepare();
  }
  prepare() {
    const {gl, grid} = this, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    this.place = new Proxy({}, {get: (kept, name) => kept[name] ||= gl.getUniformLocation(program, name)});
    this.meshes = [1, 2].map(every => this.mesh(every));
    this.texture(0, "cut", gl.RGBA32F);
    this.texture(1, "floors", gl.R32F);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, grid.nx, grid.ny, gl.RED, gl.FLOAT, Float32Array.from(grid.floor));
    gl.activeTexture(gl.TEXTURE0);
    gl.enable(gl.DEPTH_TEST);
    this.sent = [];
  }
  mesh(every) {  // of every cell, or of every second one
    const {gl, grid} = this, wide = grid.nx + SIDES, buffer = gl.createBuffer();
    const [across, up] = [grid.nx, grid.ny].map(n => Array.from({length: n + SIDES}, (_, v) => v)
      .filter(v => v < 2 || v > n || (v - 2) % every === 0));
    const index = new Uint32Array((across.length - 1) * (up.length - 1) * 6);
    for (let j = 0, at = 0; j < up.length - 1; j++)
      for (let i = 0; i < across.length - 1; i++) {
        const [a, b, c, d] = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([x, y]) => up[j + y] * wide + across[i + x]);
        index.set((i + j) % 2 ? [a, b, c, c, b, d] : [a, b, d, a, d, c], at);
        at += 6;
      }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STATIC_DRAW);
    return {buffer, count: index.length};
  }
  texture(unit, name, format) {
    const {gl, grid} = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, grid.nx, grid.ny);
    for (const what of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, what, gl.NEAREST);
    gl.uniform1i(this.place[name], unit);
  }
  // Send the tiles that are not those of before, and their neighbours, whose slopes change with them.
  send(map) {
    const {gl, grid} = this, cells = this.cells ||= new Float32Array(4 * TILE * TILE);
    for (const k of map.changed(this.sent)) {
      const i0 = k % grid.across * TILE, j0 = (k / grid.across | 0) * TILE, w = Math.min(TILE, grid.nx - i0), h = Math.min(TILE, grid.ny - j0);
      for (let j = 0, at = 0; j < h; j++)
        for (let i = 0; i < w; i++) {
          const {height, by} = map.at(i0 + i, j0 + j), [dx, dy] = map.slope(i0 + i, j0 + j);
          cells[at++] = height;
          cells[at++] = height > grid.floor[(j0 + j) * grid.nx + i0 + i] ? by : GONE;
          cells[at++] = dx;
          cells[at++] = dy;
        }
      gl.texSubImage2D(gl.TEXTURE_2D, 0, i0, j0, w, h, gl.RGBA, gl.FLOAT, cells.subarray(0, 4 * w * h));
      this.uploads++;
    }
  }
  draw(camera, colours, map, row, ratio, moving = false) {
    const {gl, grid, place} = this, {buffer, count} = this.meshes[this.slow && moving ? 1 : 0], [w, h] = camera.size, [low, high] = this.depths;
    this.send(map);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const far = [...grid.low, low].reduce((sum, v, k) => sum + Math.abs(v - camera.target[k]), 0)
      + [...grid.high, high].reduce((sum, v, k) => sum + Math.abs(v - camera.target[k]), 0);
    gl.uniform2i(place.cells, grid.nx, grid.ny);
    gl.uniform4f(place.edges, ...grid.low, ...grid.high);
    gl.uniform1f(place.cell, grid.step);
    for (const name of ["right", "up", "near", "target"]) gl.uniform3f(place[name], ...camera[name]);
    gl.uniform3f(place.size, w / 2 / camera.zoom, h / 2 / camera.zoom, far || 1);
    gl.uniform2f(place.depths, low, high);
    gl.uniform1f(place.now, row + 1);
    for (const [name, colour] of [["blank", "raw"], ["metal", "metal"], ["deep", "deep"], ["red", "crash"], ["fresh", "now"]])
      gl.uniform3f(place[name], ...rgb(colours[colour]));
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
    for (const below of camera.near[2] < 0 ? [0, 1] : [0]) {
      gl.uniform1i(place.below, below);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    }
  }
}

// Whether there is no graphics card, so that the processor draws.
function drawnByProcessor() {
  const gl = document.createElement("canvas").getContext("webgl2", {failIfMajorPerformanceCaveat: true});
  if (!gl) return true;
  const names = gl.getExtension("WEBGL_debug_renderer_info"), name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

// A colour of the style sheet, #rrggbb, as three shares.
function rgb(text) {
  return [1, 3, 5].map(k => parseInt(text.slice(k, k + 2), 16) / 255);
}
