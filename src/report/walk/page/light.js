// The light at the corners of all faces: as solved, or with lamps dimmed by their shares.

/// Vertices are the corners of a face, then its centroid; a face's first is firstCorner[face] + face.
export class Light {
  constructor(model) {
    this.model = model;
    this.dims = model.shares.map(() => 1);
    this.own = model.light;            // by the face's own patch: what is read off
    this.smooth = new Float32Array(model.light.length);  // corners: the mean of the faces that meet there
    this.findPoints();
    this.run();
  }

  /// The point of each corner, counted over all polygons, and how many faces meet there.
  findPoints() {
    const m = this.model, points = m.point_count.reduce((sum, n) => sum + n, 0);
    this.pointOf = new Uint32Array(m.corners.length);
    this.meeting = new Uint16Array(points);
    for (let polygon = 0; polygon < m.polygons; ++polygon) {
      const end = m.firstCorner[m.firstFace[polygon + 1]];
      for (let i = m.firstCorner[m.firstFace[polygon]]; i < end; ++i) {
        this.pointOf[i] = m.firstPoint[polygon] + m.corners[i];
        ++this.meeting[this.pointOf[i]];
      }
    }
    this.sums = new Float32Array(points * m.channels);
  }

  /// Smooths `own` over the corners.
  run() {
    const { channels: n, faces, firstCorner } = this.model, { own, smooth, sums, pointOf, meeting } = this;
    sums.fill(0);
    const each = (act) => {
      for (let face = 0; face < faces; ++face) {
        for (let i = firstCorner[face]; i < firstCorner[face + 1]; ++i) {
          for (let c = 0; c < n; ++c) act(pointOf[i], (i + face) * n + c, c);
        }
      }
    };
    each((point, at, c) => { sums[point * n + c] += own[at]; });
    smooth.set(own);
    each((point, at, c) => { smooth[at] = sums[point * n + c] / meeting[point]; });
  }

  /// Sets what each lamp gives, 1 for all that it was solved with.
  dim(dims) {
    this.dims = dims;
    const whole = this.model.light;
    if (dims.every((d) => d === 1)) {
      this.own = whole;
    } else {
      const sum = new Float32Array(whole.length);
      this.model.shares.forEach((share, k) => {
        const d = dims[k];
        if (d !== 0) for (let i = 0; i < sum.length; ++i) sum[i] += d * share.light[i];
      });
      this.own = sum;
    }
    this.run();
  }

  /// What a polygon's own emission is multiplied by.
  emission(polygon) {
    const lamp = this.model.lamp?.[polygon] ?? 0;
    return lamp > 0 ? this.dims[lamp - 1] : 1;
  }
}
