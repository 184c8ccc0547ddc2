// Where two pictures differ, in false colour: black where they are equal, then blue, red, yellow and white.

const STOPS = [[0, 0, 0], [40, 60, 200], [220, 40, 60], [255, 220, 60], [255, 255, 255]];
const LIMITS = [0, 1, 8, 32, 255];  // differences of a byte at which these colours are reached

function colorOf(difference) {
  const i = Math.max(1, LIMITS.findIndex((limit) => difference <= limit));
  const part = (difference - LIMITS[i - 1]) / (LIMITS[i] - LIMITS[i - 1]);
  return STOPS[i - 1].map((low, c) => low + part * (STOPS[i][c] - low));
}

export function difference(a, b, canvas, width, height) {
  const picture = new ImageData(width, height);
  let squares = 0, different = 0, most = 0;
  for (let i = 0; i < a.length; i += 4) {
    let largest = 0;
    for (let c = i; c < i + 3; ++c) {
      squares += (a[c] - b[c]) ** 2;
      largest = Math.max(largest, Math.abs(a[c] - b[c]));
    }
    different += largest > 0;
    most = Math.max(most, largest);
    picture.data.set([...colorOf(largest), 255], i);
  }
  Object.assign(canvas, { width, height });
  canvas.getContext("2d").putImageData(picture, 0, 0);
  return { different, most, psnr: 10 * Math.log10((255 ** 2 * 3 * width * height) / squares) };
}
