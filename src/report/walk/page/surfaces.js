// All faces as one mesh, shaded by the solution alone: no light of three.js takes part.
import * as THREE from "three";

const vertexShader = `
uniform highp sampler2D polygons;  // two texels each: reflectance and storey, exitance and outside
uniform uint storeys;
uniform bool showOutside;
in float polygon;
in LIGHT light;
out vec3 irradiance, radiosity, place;
void main() {
  int k = 2 * int(polygon), wide = textureSize(polygons, 0).x;
  vec4 a = texelFetch(polygons, ivec2(k % wide, k / wide), 0);
  vec4 b = texelFetch(polygons, ivec2((k + 1) % wide, (k + 1) / wide), 0);
  bool shown = (storeys >> uint(a.w) & 1u) == 1u && (showOutside || b.w == 0.0);
  irradiance = vec3(light);
  radiosity = b.rgb + a.rgb * irradiance;
  place = position;
  gl_Position = shown ? projectionMatrix * modelViewMatrix * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragmentShader = `
uniform sampler2D palette;
uniform vec3 weights;
uniform bool falseColour, logarithmic, showBacks;
uniform float exposure, white, lowest, highest, cut, steps;
in vec3 irradiance, radiosity, place;
out vec4 colour;
vec3 srgb(vec3 x) {
  return mix(12.92 * x, 1.055 * pow(max(x, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}
void main() {
  if (place.z > cut) discard;
  if (!gl_FrontFacing) {
    if (!showBacks) discard;
    colour = vec4(vec3(0.10), 1.0);
    return;
  }
  if (falseColour) {
    float e = max(dot(weights, irradiance), 0.0);
    float t = logarithmic ? log(max(e, lowest) / lowest) / log(highest / lowest) : (e - lowest) / (highest - lowest);
    t = clamp(t, 0.0, 1.0);
    if (steps > 0.0) t = (floor(min(t * steps, steps - 0.001)) + 0.5) / steps;
    float texels = float(textureSize(palette, 0).x);
    colour = texture(palette, vec2((t * (texels - 1.0) + 0.5) / texels, 0.5));
    return;
  }
  // Reinhard, Stark, Shirley and Ferwerda 2002, equation 4, as in Enfilade's pictures.
  vec3 b = max(radiosity, 0.0);
  float l = exposure * dot(b, vec3(0.2126, 0.7152, 0.0722));
  colour = vec4(srgb(clamp(b * exposure * (1.0 + l / (white * white)) / (1.0 + l), 0.0, 1.0)), 1.0);
}`;

function positions(model) {
  const { frames, points, middles, corners, firstPoint, firstFace, firstCorner } = model;
  const at = new Float32Array(3 * (corners.length + model.faces));
  const polygonOf = new Float32Array(corners.length + model.faces);
  let next = 0;
  const put = (polygon, x, y) => {
    for (let c = 0; c < 3; ++c)
      at[3 * next + c] = frames[9 * polygon + c] + x * frames[9 * polygon + 3 + c] + y * frames[9 * polygon + 6 + c];
    polygonOf[next++] = polygon;
  };
  for (let polygon = 0; polygon < model.polygons; ++polygon) {
    for (let face = firstFace[polygon]; face < firstFace[polygon + 1]; ++face) {
      for (let i = firstCorner[face]; i < firstCorner[face + 1]; ++i) {
        const p = 2 * (firstPoint[polygon] + corners[i]);
        put(polygon, points[p], points[p + 1]);
      }
      put(polygon, middles[2 * face], middles[2 * face + 1]);
    }
  }
  return { at, polygonOf };
}

/// A fan of triangles about each face's centroid.
function triangles({ faces, firstCorner, corners }) {
  const index = new Uint32Array(3 * corners.length);
  let next = 0;
  for (let face = 0; face < faces; ++face) {
    const first = firstCorner[face] + face, count = firstCorner[face + 1] - firstCorner[face];
    for (let i = 0; i < count; ++i) {
      index[next++] = first + count;
      index[next++] = first + i;
      index[next++] = first + (i + 1) % count;
    }
  }
  return index;
}

const texels = 1024;

function fillPolygons(model, light, data) {
  const n = model.channels;
  for (let k = 0; k < model.polygons; ++k) {
    const emission = light.emission(k);
    for (let c = 0; c < 3; ++c) {
      data[8 * k + c] = model.reflectance[k * n + Math.min(c, n - 1)];
      data[8 * k + 4 + c] = emission * model.exitance[k * n + Math.min(c, n - 1)];
    }
    data[8 * k + 3] = Math.min(model.storey[k], 31);
    data[8 * k + 7] = model.outside[k];
  }
}

function polygonTexture(model, light) {
  const rows = Math.max(1, Math.ceil((2 * model.polygons) / texels));
  const texture = new THREE.DataTexture(new Float32Array(4 * texels * rows), texels, rows, THREE.RGBAFormat, THREE.FloatType);
  fillPolygons(model, light, texture.image.data);
  texture.needsUpdate = true;
  return texture;
}

function paletteTexture(colours) {
  const texture = new THREE.DataTexture(Uint8Array.from(colours.flatMap((c) => [...c, 255])), colours.length, 1);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export class Surfaces {
  constructor(model, light) {
    this.model = model;
    this.light = light;
    const { at, polygonOf } = positions(model);
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(at, 3));
    this.geometry.setAttribute("polygon", new THREE.BufferAttribute(polygonOf, 1));
    this.geometry.setIndex(new THREE.BufferAttribute(triangles(model), 1));
    this.smoothed = true;
    this.showLight();
    const weights = [0, 1, 2].map((c) => model.weights[c] ?? 0);
    this.uniforms = Object.fromEntries(Object.entries({
      polygons: polygonTexture(model, light), palette: paletteTexture(model.palette), storeys: 0xffffffff, showOutside: true,
      showBacks: false, weights: new THREE.Vector3(...weights), falseColour: false, logarithmic: true, exposure: model.exposure,
      white: model.white, lowest: 1, highest: 1000, cut: 1e30, steps: 0,
    }).map(([name, value]) => [name, { value }]));
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, vertexShader, fragmentShader, side: THREE.DoubleSide,
      defines: { LIGHT: model.channels === 1 ? "float" : "vec3" },
    });
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
  }

  showLight() {
    const values = this.smoothed ? this.light.smooth : this.light.own;
    this.geometry.setAttribute("light", new THREE.BufferAttribute(values, this.model.channels));
  }

  /// After lamps were dimmed.
  relight() {
    const { polygons } = this.uniforms;
    fillPolygons(this.model, this.light, polygons.value.image.data);
    polygons.value.needsUpdate = true;
    this.geometry.deleteAttribute("light");
    this.showLight();
  }
}
