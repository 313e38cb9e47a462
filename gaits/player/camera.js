// What part of the world is seen, and the terrain in it.
const world = (() => {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x, y) => {
    box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y);
  };
  for (const stance of plan.stances) {
    add(...stance.com);
    for (const leg in stance.feet) add(...place(stance.feet[leg]));
  }
  for (const transfer of plan.transfers) add(...place(transfer.place.foothold));
  for (const leg in data.scene.start) add(...place(data.scene.start[leg]));
  if (box[0] > box[2]) for (const {points} of data.terrain.surface) for (const p of points) add(...p);
  if (box[0] > box[2]) add(0, 0);
  const {com_x, com_y} = data.scene.goal;
  if (com_x) for (const x of com_x) add(x, box[1]);
  if (com_y) for (const y of com_y) add(box[0], y);
  return box;
})();

/** The camera: `whole` shows the whole way, else it follows the robot, a reach being a fair share of the picture. */
const camera = {
  whole: true, zoom: 1, width: 1, height: 1, scale: 1, x: 0, y: 0,
  wholeScale() {
    const room = 0.9 * reachMax;
    return Math.min(this.width / (world[2] - world[0] + room), this.height / (world[3] - world[1] + room));
  },
  followScale() { return Math.min(this.width / 4.2, this.height / 2.6) / reachMax; },
  aim(t) {
    this.scale = (this.whole ? this.wholeScale() : this.followScale()) * this.zoom;
    if (this.whole && this.zoom === 1) {
      this.x = (world[0] + world[2]) / 2;
      this.y = (world[1] + world[3]) / 2;
      return;
    }
    // The mean over a window of the way: it moves evenly while the COM stops and goes.
    const at = s => {
      const k = clamp(Math.floor(s), 0, steps), next = Math.min(k + 1, steps);
      return between(plan.stances[k].com, plan.stances[next].com, clamp(s, 0, steps) - k);
    };
    this.x = this.y = 0;
    const samples = [-1, -0.5, 0, 0.5, 1];
    if (!plan.stances.length) [this.x, this.y] = [(world[0] + world[2]) / 2, (world[1] + world[3]) / 2];
    else for (const d of samples) {
      const p = at(t + 0.5 + d);
      this.x += p[0] / samples.length;
      this.y += (p[1] - 0.3 * reachMax) / samples.length;
    }
  },
  px(p) { return [this.width / 2 + (p[0] - this.x) * this.scale, this.height / 2 - (p[1] - this.y) * this.scale]; },
  /** What is seen [m], grown by a margin [px]: xmin, ymin, xmax, ymax. */
  window(margin) {
    const w = (this.width / 2 + margin) / this.scale, h = (this.height / 2 + margin) / this.scale;
    return [this.x - w, this.y - h, this.x + w, this.y + h];
  },
};

/** The part of a polygon in a window (Sutherland and Hodgman). */
function clipped(polygon, window) {
  for (let side = 0; side < 4 && polygon.length; ++side) {
    const axis = side % 2, sign = side < 2 ? 1 : -1, out = [];
    for (let i = 0; i < polygon.length; ++i) {
      const a = polygon[i], b = polygon[(i + 1) % polygon.length];
      const da = sign * (a[axis] - window[side]), db = sign * (b[axis] - window[side]);
      if (da >= 0) out.push(a);
      if ((da < 0) !== (db < 0)) out.push(between(a, b, da / (da - db)));
    }
    polygon = out;
  }
  return polygon;
}

/** The part of a line in a window, its ends as they were where they lie inside; null if there is none (Liang and
    Barsky). A line of a million pixels is not for a canvas. */
function cut(a, b, window) {
  let begin = 0, end = 1;
  for (let side = 0; side < 4; ++side) {
    const axis = side % 2, sign = side < 2 ? 1 : -1;
    const at = sign * (a[axis] - window[side]), change = sign * (b[axis] - a[axis]);
    if (change === 0 && at < 0) return null;
    if (change > 0) begin = Math.max(begin, -at / change);
    if (change < 0) end = Math.min(end, -at / change);
  }
  if (begin > end) return null;
  return [begin > 0 ? between(a, b, begin) : a, end < 1 ? between(a, b, end) : b];
}

/** Terrain near the camera; cut anew only when the camera leaves it, so that long terrain costs nothing per frame. */
const nearby = {
  window: null, ground: [], surface: [],
  update() {
    const seen = camera.window(20), have = this.window;
    const size = seen[2] - seen[0];
    if (have && seen[0] >= have[0] && seen[1] >= have[1] && seen[2] <= have[2] && seen[3] <= have[3] &&
        have[2] - have[0] < 6 * size) return;
    const wide = camera.window(camera.width);
    this.window = wide;
    this.ground = data.terrain.ground.map(polygon => clipped(polygon, wide)).filter(polygon => polygon.length > 2);
    this.surface = [];
    for (const run of data.terrain.surface) {
      let points = [];
      const close = () => { if (points.length) this.surface.push({...run, points}); points = []; };
      for (let i = 1; i < run.points.length; ++i) {
        const a = run.points[i - 1], b = run.points[i], piece = cut(a, b, wide);
        if (!piece) continue;
        if (piece[0] !== a) close();
        if (!points.length) points.push(piece[0]);
        points.push(piece[1]);
        if (piece[1] !== b) close();
      }
      close();
    }
  },
};
