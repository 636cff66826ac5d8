// The building as the page holds it: what report/walk/walk_arrays.hpp describes.

function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// The bytes of each number together again; `at` is where the array begins.
function numbers(data, at, { name, bytes, length }) {
  const whole = new Uint8Array(bytes * length);
  for (let plane = 0; plane < bytes; ++plane) {
    const from = at + plane * length;
    for (let i = 0; i < length; ++i) whole[i * bytes + plane] = data[from + i];
  }
  const floats = ["frames", "reflectance", "exitance", "points", "middles"].includes(name);
  if (floats) return new Float32Array(whole.buffer);
  return bytes === 1 ? whole : bytes === 2 ? new Uint16Array(whole.buffer) : new Uint32Array(whole.buffer);
}

/// IEEE 754 numbers of 16 bits, times `scale`.
function unpackHalves(halves, scale) {
  const value = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const exponent = (h >> 10) & 31, digits = h & 1023;
    const size = exponent === 0 ? digits * 2 ** -24 : (1024 + digits) * 2 ** (exponent - 25);
    value[h] = (h & 32768 ? -size : size) * scale;
  }
  return Float32Array.from(halves, (h) => value[h]);
}

/// Where each polygon's, or each face's, part of an array begins, and at last where the array ends.
function starts(counts) {
  const first = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) first[i + 1] = first[i] + counts[i];
  return first;
}

export async function loadModel() {
  const model = JSON.parse(document.getElementById("model").textContent);
  const element = document.getElementById("data");
  const data = await inflated(bytesOf(element.textContent));
  element.textContent = "";
  let at = 0;
  for (const entry of model.arrays) {
    model[entry.name] = numbers(data, at, entry);
    at += Math.ceil((entry.bytes * entry.length) / 4) * 4;
  }
  model.light = unpackHalves(model.light, model.scale);
  model.shares = (model.shares ?? []).map((share, k) => ({
    ...share, light: unpackHalves(model[`share_${k}`], share.scale) }));
  model.firstPoint = starts(model.point_count);
  model.firstFace = starts(model.face_count);
  model.firstCorner = starts(model.corner_count);
  return model;
}

/// One value of a light's channels, in the unit of the scene.
export function oneValue(model, light) {
  let sum = 0;
  for (let c = 0; c < model.channels; ++c) sum += model.weights[c] * light[c];
  return sum;
}

/// A number as people read it: three digits, no more.
export function shown(value) {
  if (!Number.isFinite(value)) return "";
  if (value !== 0 && (Math.abs(value) < 0.001 || Math.abs(value) >= 1e6)) return value.toExponential(2);
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.max(Math.abs(value), 1e-3))));
  return value.toFixed(Math.min(digits, value === 0 ? 0 : 5));
}
