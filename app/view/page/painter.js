// The page's own painter: a fragment shader that casts rays into textures, by the rules of the server's painter.
import { raysOf } from "/rays.js";
import { Textures } from "/textures.js";

const PARTS = ["numbers", "field", "ground", "light", "clear", "picture"];
const SWITCHES = { glow: "GLOW", clear: "CLEAR", tinted: "TINTED", obstacles: "OBSTACLES", ground: "GROUND", rock: "ROCK" };
const CORNERS = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

const texts = Promise.all(PARTS.map(async (name) => (await fetch(`/${name}.glsl`)).text()));

function compiled(gl, type, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

export class TexturePainter {
  // Throws if the browser cannot do it.
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("This browser has no WebGL 2.");
    this.textures = new Textures(this.gl);
    this.programs = new Map();  // by the switches that they were made with
    this.frame = this.gl.createFramebuffer();
    this.plain = null;  // the picture with one sample a pixel
  }

  async program() {
    const numbers = this.textures.numbers;
    const on = Object.keys(SWITCHES).filter((name) => numbers[name][0]).map((name) => `#define ${SWITCHES[name]}\n`).join("");
    if (!this.programs.has(on)) this.programs.set(on, this.link(on));
    return this.programs.get(on);
  }
  async link(switches) {
    const gl = this.gl, program = gl.createProgram();
    gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, CORNERS));
    gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, `#version 300 es\n${switches}${(await texts).join("\n")}`));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  // Takes over a message of the server, and gets ready to draw.
  async take(bytes) {
    const news = await this.textures.take(bytes);
    this.ready = await this.program();
    return news;
  }

  set(program, values) {
    const gl = this.gl;
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const { name, type } = gl.getActiveUniform(program, i), key = name.replace("[0]", "");
      if (!(key in values)) continue;
      const where = gl.getUniformLocation(program, name), value = [values[key]].flat();
      if (type === gl.INT) gl.uniform1iv(where, values[key].length ? values[key] : value);
      else if (type === gl.INT_VEC2) gl.uniform2iv(where, values[key]);
      else if (type === gl.INT_VEC3) gl.uniform3iv(where, values[key]);
    }
  }

  // Draws what the camera sees. A fine picture has eight samples where a pixel differs from a neighbour.
  draw(camera, width, height, fine) {
    const gl = this.gl, program = this.ready;
    if (!program) return;
    this.resize(width, height);
    gl.useProgram(program);
    const unit = this.textures.bind(program), numbers = this.textures.numbers;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, null);
    const rays = raysOf(camera, width, height, numbers.cells);
    this.set(program, { ...numbers, ...rays, size: [width, height], samples: 1 });
    gl.uniform1i(gl.getUniformLocation(program, "plain"), unit);  // no sampler may share a unit
    gl.viewport(0, 0, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, fine ? this.frame : null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (!fine) return;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindTexture(gl.TEXTURE_2D, this.plain);
    gl.uniform1i(gl.getUniformLocation(program, "samples"), 8);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  resize(width, height) {
    const gl = this.gl;
    if (this.plain && this.canvas.width === width && this.canvas.height === height) return;
    Object.assign(this.canvas, { width, height });
    gl.deleteTexture(this.plain);
    this.plain = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.plain);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.plain, 0);
  }

  // The picture's bytes, red, green, blue and 255, rows from the top.
  pixels() {
    const gl = this.gl, { width, height } = this.canvas, row = 4 * width;
    const below = new Uint8Array(row * height), result = new Uint8ClampedArray(row * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, below);
    for (let y = 0; y < height; ++y) result.set(below.subarray(row * (height - 1 - y), row * (height - y)), row * y);
    return result;
  }
}
