// The textures that the server keeps, on the graphics processor. A message brings the bricks that have changed.

// By format: WebGL's format inside, that of the bytes, their type, and the view of them.
const kinds = (gl) => ({
  u16: [gl.R16UI, gl.RED_INTEGER, gl.UNSIGNED_SHORT, Uint16Array, 2],
  u8x4: [gl.RGBA8UI, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, Uint8Array, 4],
  u32x2: [gl.RG32UI, gl.RG_INTEGER, gl.UNSIGNED_INT, Uint32Array, 8],
  u32x4: [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, Uint32Array, 16],
  i32: [gl.R32I, gl.RED_INTEGER, gl.INT, Int32Array, 4],
  i32x2: [gl.RG32I, gl.RG_INTEGER, gl.INT, Int32Array, 8],
});

const inflated = (bytes) =>
  new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();

export class Textures {
  constructor(gl) {
    this.gl = gl;
    this.kinds = kinds(gl);
    this.list = [];  // in the server's order: { name, format, size, brick, handle }
    this.numbers = null;
    this.version = 0;
  }

  // Takes over a message. What it says is taken over whole or, if it cannot be read, not at all.
  async take(bytes) {
    const plain = await inflated(bytes);
    const length = new DataView(plain).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(plain, 4, length)));
    if (head.everything) this.begin(head.textures);
    this.upload(plain, 4 + length, head.bricks);
    this.numbers = head.numbers;
    this.version = head.version;
    return { ...head, bytes: plain.byteLength - 4 - length };
  }

  begin(textures) {
    const gl = this.gl;
    this.list.forEach((one) => gl.deleteTexture(one.handle));
    this.list = textures.map((one) => {
      const handle = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_3D, handle);
      gl.texStorage3D(gl.TEXTURE_3D, 1, this.kinds[one.format][0], ...one.size);  // zeros
      gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      return { ...one, handle };
    });
  }

  upload(plain, first, count) {
    const gl = this.gl;
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    let at = first, bound = -1;
    for (let i = 0; i < count; ++i) {
      const [which, x, y, z] = new Uint16Array(plain, at, 4);
      const { handle, format, brick } = this.list[which];
      const [, outside, type, View, texel] = this.kinds[format];
      const bytes = brick[0] * brick[1] * brick[2] * texel;
      if (bound !== which) gl.bindTexture(gl.TEXTURE_3D, handle);
      bound = which;
      gl.texSubImage3D(gl.TEXTURE_3D, 0, x, y, z, ...brick, outside, type,
                       new View(plain, at + 8, bytes / View.BYTES_PER_ELEMENT));
      at += 8 + bytes;
    }
  }

  bind(program) {
    const gl = this.gl;
    this.list.forEach(({ name, handle }, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_3D, handle);
      gl.uniform1i(gl.getUniformLocation(program, name), unit);
    });
    return this.list.length;  // the first unit that is free
  }

  // Reads a slice back, for tests: its numbers, as the graphics processor has them.
  slice(name, z) {
    const gl = this.gl, { handle, format, size } = this.list.find((one) => one.name === name);
    const frame = gl.createFramebuffer(), signed = format[0] === "i";
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, handle, 0, z);
    const numbers = new (signed ? Int32Array : Uint32Array)(4 * size[0] * size[1]);
    gl.readPixels(0, 0, size[0], size[1], gl.RGBA_INTEGER, signed ? gl.INT : gl.UNSIGNED_INT, numbers);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(frame);
    const parts = { u16: 1, u8x4: 4, u32x2: 2, u32x4: 4, i32: 1, i32x2: 2 }[format];
    return numbers.filter((_, i) => i % 4 < parts);
  }
}
