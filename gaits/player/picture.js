// Draws a moment on the canvas.
const colours = {};

/** Colours come from the style sheet, which knows light and dark. */
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "faint", "sky", "ground", "usual", "less", "more", "goal", "goal-ink", "region", "path",
    "weak", "leg1", "leg2", "leg3", "body", "halo", "balance", "contacts"])
    colours[name] = style.getPropertyValue("--" + name).trim();
}

/** Things that can be pointed at: `at` a point or `from`, `to` a line [px]; the last drawn lies on top. */
let targets = [];

const canvas = document.getElementById("stage");
const pen = canvas.getContext("2d");

function trace(points, closed) {
  points.forEach((p, i) => i ? pen.lineTo(...camera.px(p)) : pen.moveTo(...camera.px(p)));
  if (closed) pen.closePath();
}

function stroke(points, colour, width, dash = []) {
  pen.beginPath();
  trace(points, false);
  pen.strokeStyle = colour; pen.lineWidth = width; pen.setLineDash(dash);
  pen.stroke();
  pen.setLineDash([]);
}

function disc(at, radius, fill, edge, width = 1.5) {
  pen.beginPath();
  pen.arc(...at, radius, 0, 2 * Math.PI);
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (edge) { pen.strokeStyle = edge; pen.lineWidth = width; pen.stroke(); }
}

function label(text, at, {colour = colours.ink, size = 12, bold = false, align = "center"} = {}) {
  pen.font = `${bold ? "bold " : ""}${size}px system-ui, sans-serif`;
  pen.textAlign = align;
  pen.lineWidth = 3; pen.strokeStyle = colours.halo; pen.lineJoin = "round";
  pen.strokeText(text, ...at);
  pen.fillStyle = colour;
  pen.fillText(text, ...at);
}

function drawGoal() {
  const {com_x, com_y} = data.scene.goal, seen = camera.window(0);
  const from = [com_x ? com_x[0] : seen[0], com_y ? com_y[1] : seen[3]];
  const to = [com_x ? com_x[1] : seen[2], com_y ? com_y[0] : seen[1]];
  if (from[0] > seen[2] || to[0] < seen[0] || from[1] < seen[1] || to[1] > seen[3]) return;
  const [x0, y0] = camera.px([clamp(from[0], seen[0], seen[2]), clamp(from[1], seen[1], seen[3])]);
  const [x1, y1] = camera.px([clamp(to[0], seen[0], seen[2]), clamp(to[1], seen[1], seen[3])]);
  pen.fillStyle = colours.goal;
  pen.fillRect(x0, y0, Math.max(2, x1 - x0), Math.max(2, y1 - y0));
  label("goal", [clamp((x0 + x1) / 2, 24, camera.width - 24), Math.max(y0, 0) + 16],
    {colour: colours["goal-ink"], bold: true});
}

/** Within reach of every standing foot: the discs cut what is drawn. */
function drawRegion(now) {
  const region = regionAt(now);
  if (!region.rings.length) return;
  pen.save();
  for (const foot of region.feet) {
    pen.beginPath();
    pen.arc(...camera.px(foot), reachMax * camera.scale, 0, 2 * Math.PI);
    pen.clip();
  }
  pen.beginPath();
  for (const ring of region.rings) trace(ring, true);
  pen.fillStyle = pen.strokeStyle = colours.region;
  pen.globalAlpha = 0.26; pen.fill("evenodd");
  pen.globalAlpha = 0.9; pen.lineWidth = 2; pen.stroke();
  pen.restore();
  targets.push({region, words: () => regionWords(region)});
}

function drawGround() {
  pen.fillStyle = colours.ground;
  for (const polygon of nearby.ground) {
    pen.beginPath();
    trace(polygon, true);
    pen.fill();
  }
}

function drawSurface() {
  for (const {grip, foothold, hatched, points} of nearby.surface) {
    if (hatched) hatch(points);
    stroke(points, colours[grip], grip === "usual" ? 2.4 : 3.6);
    if (!foothold) stroke(points, colours.sky, 1.6, [2, 5]);
  }
}

/** Short strokes into the solid side, which lies to the right of the way. */
function hatch(points) {
  pen.beginPath();
  for (let i = 1; i < points.length; ++i) {
    const a = camera.px(points[i - 1]), b = camera.px(points[i]), length = distance(a, b);
    const along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length], right = [-along[1], along[0]];
    for (let s = 4; s < length; s += 8) {
      const p = [a[0] + along[0] * s, a[1] + along[1] * s];
      pen.moveTo(...p);
      pen.lineTo(p[0] + 7 * (right[0] - along[0]), p[1] + 7 * (right[1] - along[1]));
    }
  }
  pen.strokeStyle = colours.faint; pen.lineWidth = 1;
  pen.stroke();
}

function seesPoint(p) {
  const [x, y] = camera.px(p), margin = 40;
  return x > -margin && y > -margin && x < camera.width + margin && y < camera.height + margin;
}

function drawPath(now) {
  const done = now.step + (now.phase === "move" ? 0 : now.phase === "lift" ? 1 : 0);
  const spacing = distance(world.slice(0, 2), world.slice(2)) * camera.scale / Math.max(1, steps);  // px
  for (let k = 0; k < steps; ++k) {
    const from = plan.stances[k].com, to = plan.stances[k + 1].com;
    if (!seesPoint(from) && !seesPoint(to) && distance(from, to) * camera.scale < camera.width) continue;
    const weakest = data.weakest && data.weakest.in_transfer && data.weakest.index === k;
    if (weakest) stroke([from, to], colours.weak, 7);
    stroke([from, to], colours.path, k < done ? 2.2 : 1.4, k < done ? [] : [4, 4]);
    targets.push({from: camera.px(from), to: camera.px(to), t: k + touchDown, words: () => transferWords(k)});
  }
  for (let k = 0; k < plan.stances.length; ++k) {
    const com = plan.stances[k].com;
    if (!seesPoint(com)) continue;
    const at = camera.px(com);
    if (data.weakest && !data.weakest.in_transfer && data.weakest.index === k) disc(at, 8, colours.weak);
    disc(at, spacing < 8 ? 1.5 : 3.2, colours.halo, colours.path);
    if (spacing > 22 && k < steps && distance(at, camera.px(now.com)) > 14)
      label(String(k + 1), [at[0], at[1] - 8], {size: 10, colour: colours.faint});
    targets.push({at, t: k, words: () => stanceWords(k)});
  }
}

/** Where feet stood and will stand. */
function drawFootholds(now) {
  const radius = clamp(0.07 * reachMax * camera.scale, 1, 3.4);
  const dot = (leg, foot, past, k) => {
    if (!seesPoint(place(foot))) return;
    const at = camera.px(place(foot));
    pen.globalAlpha = past ? 0.45 : 1;
    disc(at, radius, past ? colours["leg" + leg] : colours.halo, colours["leg" + leg], 0.47 * radius);
    pen.globalAlpha = 1;
    const when = k < 0 ? "where it stands at the start" : `placed in step ${k + 1}`;
    targets.push({at, t: k + touchDown, words: () => [`Leg ${leg}, ${when}`, ...footWords(foot)]});
  };
  for (const leg in data.scene.start) dot(leg, data.scene.start[leg], true, -1);
  plan.transfers.forEach((transfer, k) => dot(transfer.place.leg, transfer.place.foothold, k <= now.step, k));
}

/** The friction cone of a foot that carries. */
function drawCone(foot) {
  const [nx, ny] = foot.normal, mu = foot.friction, length = 24, at = camera.px(place(foot));
  const edge = sign => {
    const d = [nx + sign * mu * ny, ny - sign * mu * nx], size = Math.hypot(...d);
    return [at[0] + length * d[0] / size, at[1] - length * d[1] / size];
  };
  pen.beginPath();
  pen.moveTo(...at); pen.lineTo(...edge(1)); pen.lineTo(...edge(-1)); pen.closePath();
  pen.globalAlpha = 0.28; pen.fillStyle = colours.faint; pen.fill(); pen.globalAlpha = 1;
}

function drawRobot(now) {
  const hub = camera.px(now.com), roomy = reachMax * camera.scale > 40;  // px: else only legs and COM
  for (const {foot, carries} of now.legs) if (carries && roomy) drawCone(foot);
  for (const {leg, tip: end, foot, carries} of now.legs) {
    const at = camera.px(end), colour = colours["leg" + leg];
    stroke([now.com, end], colour, carries ? 4.5 : 3, carries ? [] : [7, 4]);
    targets.push({from: hub, to: at, words: () => legWords(now, leg, end, foot, carries)});
  }
  for (const {leg, tip: end, foot, carries} of now.legs) {
    const at = camera.px(end), colour = colours["leg" + leg];
    if (!roomy) continue;
    if (carries) disc(at, 5, colour, colours.halo, 1.5);
    else disc(at, 4, colours.halo, colour, 2.5);
    const inward = carries && foot ? [-foot.normal[0], foot.normal[1]] : [0, 0];
    const badge = [at[0] + 16 * inward[0], at[1] + 16 * inward[1]];
    if (carries) {
      disc(badge, 8, colour, colours.halo, 1.5);
      pen.font = "bold 11px system-ui, sans-serif"; pen.textAlign = "center"; pen.fillStyle = colours.halo;
      pen.fillText(String(leg), badge[0], badge[1] + 4);
    }
    targets.push({at: carries ? badge : at, words: () => legWords(now, leg, end, foot, carries)});
    if (carries) targets.push({at, words: () => legWords(now, leg, end, foot, carries)});
  }
  if (data.scene.clearance > 0) {
    pen.setLineDash([3, 4]);
    disc(hub, data.scene.clearance * camera.scale, null, colours.body, 1);
    pen.setLineDash([]);
  }
  disc(hub, 7, colours.halo, colours.body, 2.5);
  disc(hub, 2.5, colours.body);
  targets.push({at: hub, words: () => comWords(now)});
}

/** Metres along the lower edge. */
function drawAxis() {
  const step = roundLength(90 / camera.scale), [x0, , x1] = camera.window(0), y = camera.height - 6;
  const farthest = Math.max(Math.abs(x0), Math.abs(x1));
  for (let k = Math.ceil(x0 / step); k * step <= x1; ++k) {
    const x = camera.px([k * step, 0])[0];
    pen.fillStyle = colours.faint;
    pen.fillRect(x, y, 1, 6);
    if (x < 24 || x > camera.width - 24) continue;
    label(tickLabel(k * step, step, farthest), [x, y - 4], {size: 10, colour: colours.faint});
  }
}

/** With as many digits as tell ticks apart, up to the farthest one. */
function tickLabel(x, step, farthest) {
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (decimals <= 9 && farthest < 1e7) return `${x.toFixed(decimals)} m`;
  return `${Number(x.toPrecision(clamp(Math.floor(Math.log10(farthest / step) + 2), 1, 17)))} m`;
}

/** 1, 2 or 5 times a power of ten, at least `length`. */
function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [1, 2, 5, 10].find(f => f * power >= length) * power;
}

function draw(now) {
  const ratio = window.devicePixelRatio || 1;
  const box = canvas.getBoundingClientRect();
  camera.width = box.width; camera.height = box.height;
  const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.fillStyle = colours.sky;
  pen.fillRect(0, 0, box.width, box.height);
  camera.aim(now ? now.t : 0);
  nearby.update();
  targets = [];
  drawGoal();
  if (now) drawRegion(now);
  drawGround();
  if (now) drawPath(now);
  drawSurface();
  if (now) { drawFootholds(now); drawRobot(now); }
  drawAxis();
}
