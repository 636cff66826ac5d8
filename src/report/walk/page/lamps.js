// Markers of the lamps that have no surface: points, spots and luminaires by photometric files.
import * as THREE from "three";

const px = 14, nameHeight = 0.12;  // of a marker on the screen; of its name in the building, metres
const dark = new THREE.Color(0x2c2f36), bright = new THREE.Color(0xffd34d);
const reach = 9;  // pixels from a marker within which the pointer is on it

function textureOf(width, height, paint) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  paint(canvas.getContext("2d"));
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}

function disc() {
  return textureOf(64, 64, (pen) => {
    for (const [radius, colour] of [[31, "#16181d"], [26, "#ffffff"]]) {
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(32, 32, radius, 0, 2 * Math.PI);
      pen.fill();
    }
  });
}

function label(name) {
  const font = "600 40px system-ui, sans-serif";
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = font;
  const width = Math.min(1024, Math.ceil(pen.measureText(name).width) + 24);
  const texture = textureOf(width, 56, (p) => {
    p.fillStyle = "rgba(22,24,29,0.75)";
    p.fillRect(0, 0, width, 56);
    p.font = font;
    p.fillStyle = "#fff";
    p.textBaseline = "middle";
    p.fillText(name, 12, 29, width - 24);
  });
  return { texture, shape: width / 56 };
}

export class Lamps {
  constructor(model) {
    this.model = model;
    this.group = new THREE.Group();
    this.group.renderOrder = 1;
    const map = disc(), labels = new Map();
    this.markers = model.lights.map((light) => {
      const marker = new THREE.Sprite(new THREE.SpriteMaterial({ map, sizeAttenuation: false, alphaTest: 0.5, toneMapped: false }));
      marker.position.fromArray(light.p);
      this.group.add(marker);
      if (light.name) {
        if (!labels.has(light.name)) labels.set(light.name, label(light.name));
        const { texture, shape } = labels.get(light.name);
        const words = new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, toneMapped: false }));
        words.center.set(0.5, -0.6);
        words.scale.set(nameHeight * shape, nameHeight, 1);
        words.position.copy(marker.position);
        this.group.add(words);
        marker.userData.words = words;
      }
      return marker;
    });
    this.dim(model.shares.map(() => 1));
  }

  /// What a lamp gives of its light.
  dimOf(index) {
    const { share } = this.model.lights[index];
    return share > 0 ? this.dims[share - 1] : 1;
  }
  dim(dims) {
    this.dims = dims;
    this.markers.forEach((marker, i) => marker.material.color.lerpColors(dark, bright, Math.min(1, this.dimOf(i))));
  }

  /// Those of the storeys that are shown; `high` is the picture's height in pixels.
  show(storeys, camera, high) {
    const size = (2 * Math.tan(0.5 * THREE.MathUtils.degToRad(camera.fov)) * px) / high;
    this.markers.forEach((marker, i) => {
      marker.visible = (storeys >>> Math.min(this.model.lights[i].storey, 31) & 1) === 1;
      marker.scale.set(size, size, 1);
      if (marker.userData.words) marker.userData.words.visible = marker.visible;
    });
  }

  /// The lamp whose marker lies within reach of a point of the canvas and before what the ray there meets: {index, name, dim},
  /// else null.
  at(x, y, camera, canvas, distance) {
    const box = canvas.getBoundingClientRect();
    let best = null, nearest = reach;
    this.markers.forEach((marker, index) => {
      if (!marker.visible || marker.position.distanceTo(camera.position) > distance + 0.1) return;
      const on = marker.position.clone().project(camera);
      if (on.z > 1) return;
      const off = Math.hypot(box.left + (0.5 + 0.5 * on.x) * box.width - x, box.top + (0.5 - 0.5 * on.y) * box.height - y);
      if (off >= nearest) return;
      nearest = off;
      best = { index, name: this.model.lights[index].name || `lamp ${index + 1}`, dim: this.dimOf(index) };
    });
    return best;
  }
}
