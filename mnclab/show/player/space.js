// Lines and bodies in the depth of a picture (WebGL 2), beside the part: what lies behind metal is not seen.

const CAMERA = `#version 300 es
precision highp float;
uniform vec3 right, up, near, target;
uniform vec3 size;  // half of the picture in mm, and of its depth
vec3 eye(vec3 place) {
  return vec3(dot(place - target, right), dot(place - target, up), dot(place - target, near));
}
`;
const BODY = CAMERA + `
in vec3 place, normal;
uniform vec3 at;
uniform mat3 turn;
out vec3 out_of;
out vec3 where;
void main() {
  vec3 seen = eye(turn * place + at), way = turn * normal;
  out_of = vec3(dot(way, right), dot(way, up), dot(way, near));
  where = place;
  gl_Position = vec4(seen.xy / size.xy, -seen.z / size.z, 1.0);
}`;
const BODY_LIGHT = `#version 300 es
precision highp float;
uniform vec4 tone, stripe;
uniform float gap;  // between the lines of a hatched section, mm; 0: none
uniform bool solid;  // what is turned away is not seen
in vec3 out_of, where;
out vec4 colour;
void main() {
  vec3 across = normalize(out_of);
  if (across.z < 0.0 && solid) discard;
  if (across.z < 0.0) across = -across;
  float light = 0.5 + 0.5 * dot(across, normalize(vec3(-0.45, 0.6, 0.9)));
  float shine = pow(max(dot(across, normalize(vec3(-0.25, 0.33, 1.6))), 0.0), 40.0);
  vec3 lit = tone.rgb * (0.42 + 0.62 * light * light) * mix(0.85, 1.0, sqrt(across.z)) + 0.06 * shine;
  if (gap > 0.0) {
    float line = (where.z + abs(where.x + where.y)) / gap, wide = fwidth(line);
    lit = mix(stripe.rgb, tone.rgb, smoothstep(0.3 * wide, 0.9 * wide, abs(fract(line) - 0.5)));
  }
  colour = vec4(lit * tone.a, tone.a);
}`;
const WIRE = CAMERA + `
in vec3 from, to;
in float kind, way;
uniform float pixel, bias, width;  // mm; of a pixel, towards the eye; pixels, 0: a hair
uniform vec4 colours[16];
uniform vec2 dashes[16];
out vec4 tone;
out vec3 mark;  // pixels beside the line, along it, half of its width
flat out vec2 dash;
void main() {
  float end = float(gl_VertexID & 1), side = width > 0.0 ? float(gl_VertexID >> 1 & 1) * 2.0 - 1.0 : 0.0, half_wide = width / 2.0;
  vec3 a = eye(from), b = eye(to), along = vec3(b.xy - a.xy, 0.0);
  float length = length(along.xy) / pixel;
  along = length > 1e-6 ? normalize(along) : vec3(1.0, 0.0, 0.0);
  vec3 seen = mix(a, b, end) + pixel * (side * (half_wide + 0.7) * vec3(-along.y, along.x, 0.0) + (2.0 * end - 1.0) * half_wide * 0.6 * along);
  int k = int(kind + 0.5);
  tone = colours[k];
  dash = dashes[k];
  mark = vec3(side * (half_wide + 0.7), way / pixel + end * length, half_wide);
  gl_Position = tone.a > 0.0 ? vec4(seen.xy / size.xy, -(seen.z + bias) / size.z, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}`;
const WIRE_COLOUR = `#version 300 es
precision highp float;
uniform float strength;
in vec4 tone;
in vec3 mark;
flat in vec2 dash;
out vec4 colour;
void main() {
  if (dash.y > 0.0 && mod(mark.y, dash.x + dash.y) > dash.x) discard;
  float cover = mark.z > 0.0 ? clamp(mark.z + 0.5 - abs(mark.x), 0.0, 1.0) : 1.0;
  colour = vec4(tone.rgb, 1.0) * cover * strength;
}`;
const FACES = [0, 1, 2, 2, 1, 3];  // of the four corners of a line, those of its triangles
const STRAIGHT = [1, 0, 0, 0, 1, 0, 0, 0, 1];  // a body that is not turned
const NEARER = 2.5;  // pixels that a line is drawn nearer, so that it lies on the ground that it runs over

class Space {
  constructor(gl) {
    this.gl = gl;
    this.bodies = program(gl, BODY, BODY_LIGHT);
    this.wires = program(gl, WIRE, WIRE_COLOUR);
    this.kept = new Map();  // bodies by their names
  }
  // What all that is drawn has in common; `far` is how far it may lie from the target, mm.
  look(camera, far, ratio) {
    const {gl} = this, [w, h] = camera.size, half = [w / 2 / camera.zoom, h / 2 / camera.zoom, far || 1];
    Object.assign(this, {pixel: 1 / camera.zoom, ratio});
    for (const {use, place} of [this.bodies, this.wires]) {
      use();
      for (const name of ["right", "up", "near", "target"]) gl.uniform3f(place[name], ...camera[name]);
      gl.uniform3f(place.size, ...half);
    }
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }
  // A body of triangles, six numbers a corner: its place and the way out. `make` is called where none of the name is kept.
  body(name, make, key = name) {
    const {gl, kept} = this, before = kept.get(name);
    if (before && before.key === key) return before;
    const numbers = make(), vertices = before ? before.vertices : gl.createVertexArray(), buffer = before ? before.buffer : gl.createBuffer();
    gl.bindVertexArray(vertices);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(numbers), gl.STATIC_DRAW);
    ["place", "normal"].forEach((each, k) => {
      const at = gl.getAttribLocation(this.bodies.program, each);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 24, 12 * k);
    });
    gl.bindVertexArray(null);
    kept.set(name, {key, vertices, buffer, count: numbers.length / 6});
    return kept.get(name);
  }
  fill({vertices, count}, tone, {at = [0, 0, 0], turn = STRAIGHT, alpha = 1, stripe = tone, gap = 0, solid = false} = {}) {
    const {gl, bodies: {use, place}} = this;
    use();
    gl.uniform3f(place.at, ...at);
    gl.uniformMatrix3fv(place.turn, false, turn);
    gl.uniform4f(place.tone, ...tone, alpha);
    gl.uniform4f(place.stripe, ...stripe, 1);
    gl.uniform1f(place.gap, gap);
    gl.uniform1i(place.solid, solid);
    gl.bindVertexArray(vertices);
    gl.drawArrays(gl.TRIANGLES, 0, count);
    gl.bindVertexArray(null);
  }
  // Lines through points (3 numbers each), `kinds` of the lines that lead to them (0: none); each has four corners, as a
  // processor draws many instances of a few corners slowly.
  wire(points, kinds, before = null) {  // in the place of another one
    if (before) {
      for (const vertices of [before.hairs, before.faces]) this.gl.deleteVertexArray(vertices);
      for (const buffer of before.buffers) this.gl.deleteBuffer(buffer);
    }
    const {gl} = this, count = Math.max(kinds.length - 1, 0), corners = new Float32Array(28 * count), faces = new Uint32Array(6 * count), hairs = new Uint32Array(2 * count);
    for (let k = 0, way = 0; k < count; k++) {
      const at = 3 * k;
      for (let to = 28 * k; to < 28 * k + 28; to += 7) {
        for (let n = 0; n < 6; n++) corners[to + n] = points[at + n];
        corners[to + 6] = way;
      }
      for (let n = 0; n < 6; n++) faces[6 * k + n] = 4 * k + FACES[n];
      [hairs[2 * k], hairs[2 * k + 1]] = [4 * k, 4 * k + 1];
      way = kinds[k + 2] === kinds[k + 1] ? way + Math.hypot(points[at + 3] - points[at], points[at + 4] - points[at + 1], points[at + 5] - points[at + 2]) : 0;  // of dashes
    }
    const wire = {count, kinds: gl.createBuffer()}, buffer = (target, numbers, own = gl.createBuffer()) => {
      wire.buffers.push(own);
      gl.bindBuffer(target, own);
      gl.bufferData(target, numbers, gl.STATIC_DRAW);
    };
    wire.buffers = [wire.kinds];
    wire.index = [];
    const read = (name, size, type, stride, first) => {
      const at = gl.getAttribLocation(this.wires.program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, type, false, stride, first);
    };
    [wire.hairs, wire.faces] = [hairs, faces].map(index => {
      const vertices = gl.createVertexArray();
      gl.bindVertexArray(vertices);
      buffer(gl.ELEMENT_ARRAY_BUFFER, index);
      wire.index.push(wire.buffers[wire.buffers.length - 1]);
      if (!wire.corners) buffer(gl.ARRAY_BUFFER, corners, wire.corners = gl.createBuffer());
      gl.bindBuffer(gl.ARRAY_BUFFER, wire.corners);
      for (const [name, size, first] of [["from", 3, 0], ["to", 3, 12], ["way", 1, 24]]) read(name, size, gl.FLOAT, 28, first);
      gl.bindBuffer(gl.ARRAY_BUFFER, wire.kinds);
      read("kind", 1, gl.UNSIGNED_BYTE, 1, 0);
      return vertices;
    });
    gl.bindVertexArray(null);
    this.paint(wire, kinds);
    return wire;
  }
  paint({kinds: buffer, count}, kinds) {
    const {gl} = this, all = new Uint8Array(4 * count);
    for (let k = 0; k < count; k++) all.fill(kinds[k + 1], 4 * k, 4 * k + 4);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, all, gl.STATIC_DRAW);
  }
  // Its lines between two points, or those chosen (see patch.js); a look of each kind is [colour, dash, gap], a width in pixels
  // (0: a hair).
  stroke(wire, from, to, looks, width, strength = 1, chosen = null) {
    const {gl, wires: {use, place}, pixel} = this;
    if (to <= from || (chosen && !chosen.length)) return;
    use();
    gl.uniform1f(place.pixel, pixel);
    gl.uniform1f(place.bias, NEARER * pixel);
    gl.uniform1f(place.width, width);
    gl.uniform1f(place.strength, strength);
    const tones = new Float32Array(64), dashes = new Float32Array(32);
    looks.forEach((each, k) => {
      if (!each) return;
      tones.set([...rgb(each[0]), 1], 4 * k);
      dashes.set([each[1] || 0, each[2] || 0], 2 * k);
    });
    gl.uniform4fv(place["colours[0]"], tones);
    gl.uniform2fv(place["dashes[0]"], dashes);
    gl.bindVertexArray(width > 0 ? wire.faces : wire.hairs);
    gl.depthMask(false);
    if (chosen) this.some(wire, chosen, width > 0);
    else if (width > 0) gl.drawElements(gl.TRIANGLES, 6 * (to - from), gl.UNSIGNED_INT, 24 * from);
    else gl.drawElements(gl.LINES, 2 * (to - from), gl.UNSIGNED_INT, 8 * from);
    gl.depthMask(true);
    gl.bindVertexArray(null);
  }
  some(wire, chosen, wide) {
    const {gl} = this, each = wide ? 6 : 2, index = new Uint32Array(chosen.length / 2 * each);
    for (let k = 0, at = 0; k < chosen.length; k += 2)
      for (let n = 0; n < each; n++) index[at++] = 4 * (wide || !n ? chosen[k] : chosen[k + 1]) + FACES[n];
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.choice ||= gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STREAM_DRAW);
    gl.drawElements(wide ? gl.TRIANGLES : gl.LINES, index.length, gl.UNSIGNED_INT, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, wire.index[wide ? 1 : 0]);
  }
}

// Two shaders, and where their numbers are.
function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  const place = new Proxy({}, {get: (kept, name) => kept[name] ||= gl.getUniformLocation(made, name)});
  return {program: made, place, use: () => gl.useProgram(made)};
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
