// The safety factor over the steps, above the time bar: one bar for every stance, one for the transfer that follows.
const strip = document.getElementById("strip");
const stripPen = strip.getContext("2d");

const bars = [];
plan.stances.forEach((stance, k) => {
  const add = (begin, end, {safety_factor: sigma, limit}) =>
    bars.push({begin, end, sigma: sigma === "inf" ? Infinity : sigma, limit});
  add(k, k + touchDown, stance);
  if (k < steps) add(k + touchDown, k + 1, plan.transfers[k]);
});
const finite = bars.map(bar => bar.sigma).filter(sigma => sigma < Infinity);
finite.sort((a, b) => a - b);
const highest = clamp(finite[Math.ceil(0.95 * finite.length) - 1] || 2, 2, 20);  // the height of the strip
const pad = 8;  // px: half the thumb of the time bar

const stripX = t => pad + (strip.clientWidth - 2 * pad) * t / Math.max(steps, 0.5);
const stripTime = x => clamp((x - pad) / (strip.clientWidth - 2 * pad) * Math.max(steps, 0.5), 0, steps);

/** The bars alone, kept as a picture; only the mark of the time is drawn anew. */
const stripPicture = document.createElement("canvas");

function paintBars() {
  const ratio = window.devicePixelRatio || 1, width = strip.clientWidth, height = strip.clientHeight;
  for (const c of [strip, stripPicture]) { c.width = Math.round(width * ratio); c.height = Math.round(height * ratio); }
  const p = stripPicture.getContext("2d");
  p.setTransform(ratio, 0, 0, ratio, 0, 0);
  const base = height - 4, tall = height - 16;
  const tallness = sigma => sigma > 1 ? 4 + (tall - 4) * Math.min(1, Math.log(sigma) / Math.log(highest)) : 2;
  // Several bars may share a pixel: the lowest is seen.
  const columns = new Map();
  const gap = stripX(1) - stripX(0) > 8 ? 1 : 0;
  for (const bar of bars) {
    const from = Math.round(stripX(bar.begin)), next = Math.round(stripX(Math.min(bar.end, steps)));
    const to = Math.max(from + 1, next - gap);
    const seen = columns.get(from);
    if (!seen || seen.bar.sigma > bar.sigma) columns.set(from, {bar, from, to});
  }
  for (const {bar, from, to} of columns.values()) {
    const last = bar.begin === steps;
    p.fillStyle = bar.limit === "equilibrium" || bar.limit === "none" ? colours.balance : colours.contacts;
    const h = tallness(bar.sigma);
    p.fillRect(from, base - h, last ? pad - 2 : to - from, h);
  }
  p.fillStyle = colours.faint;
  p.fillRect(pad, base, width - 2 * pad, 1);
  if (data.weakest) {
    const {index, in_transfer: inTransfer} = data.weakest, y = base - tall - 8;
    const x = index === steps ? stripX(steps) + pad / 2 : stripX(index + (inTransfer ? 0.7 : 0.21));
    p.fillStyle = colours.weak;
    p.beginPath(); p.moveTo(x - 6, y); p.lineTo(x + 6, y); p.lineTo(x, y + 8); p.fill();
  }
}

function drawStrip(t) {
  const ratio = window.devicePixelRatio || 1;
  stripPen.setTransform(1, 0, 0, 1, 0, 0);
  stripPen.clearRect(0, 0, strip.width, strip.height);
  stripPen.drawImage(stripPicture, 0, 0);
  stripPen.setTransform(ratio, 0, 0, ratio, 0, 0);
  stripPen.fillStyle = colours.ink;
  stripPen.fillRect(stripX(t) - 1, 0, 2, strip.clientHeight);
}

/** The words for a place of the strip. */
function barWords(x) {
  const t = stripTime(x), k = Math.min(Math.floor(t), steps);
  if (!plan.stances.length) return [];
  return t - k < touchDown || k >= steps ? stanceWords(k) : transferWords(k);
}
