// What the page says about things, and what lies under the pointer. Safety factors and limits come worded from the
// program, as in its table.
const length = x => "decimals" in data ? x.toFixed(data.decimals).replace(/^-(?=[0.]*$)/, "") : String(Number(x.toPrecision(6)));
const metres = x => length(x) + " m";
const point = p => `(${length(p[0])},\u00a0${length(p[1])})`;
const listed = list => list.length < 2 ? list.join("") : list.slice(0, -1).join(", ") + " and " + list[list.length - 1];
const safety = ({factor, why}) => `safety factor ${factor}${why ? ": " + why : ""}`;

const stanceName = k => k < steps ? `Step ${k + 1} of ${steps}` : `End after ${steps} step${steps === 1 ? "" : "s"}`;

function phaseWords({step, phase, legs: shown}) {
  const standing = listed(shown.filter(leg => leg.carries).map(leg => leg.leg));
  if (phase === "end") return `the last stance, on legs ${standing}`;
  const {place: {leg}, lift} = plan.transfers[step];
  return {
    turn: `leg ${leg} swings about the COM, legs ${standing} stand`,
    place: `leg ${leg} reaches for its foothold, legs ${standing} stand`,
    move: `the COM moves, legs ${standing} stand`,
    lift: `leg ${lift} is lifted, legs ${standing} stand`,
  }[phase];
}

function stanceWords(k) {
  const name = k < steps ? `Stance of step ${k + 1}` : "Last stance";
  return [name, `COM ${point(plan.stances[k].com)}`, safety(data.stances[k])];
}

function transferWords(k) {
  const {place: {leg}, lift} = plan.transfers[k];
  const from = plan.stances[k].com, to = plan.stances[k + 1].com;
  return [`Transfer of step ${k + 1}`, `COM ${point(from)} to ${point(to)}, ${metres(distance(from, to))}`,
    `after leg ${leg} is placed, before leg ${lift} is lifted`, safety(data.transfers[k])];
}

function footWords(foot) {
  return [point(place(foot)), `chain ${foot.chain}, segment ${foot.segment}, arc length ${metres(foot.s)}`,
    `friction ${Number(foot.friction.toPrecision(3))}`];
}

function legWords(now, leg, tip, foot, carries) {
  const length = distance(now.com, tip);
  const reach = `${metres(length)} long; reach ${metres(reachMin)} to ${metres(reachMax)}`;
  if (carries) return [`Leg ${leg} stands`, ...footWords(foot), reach];
  return [`Leg ${leg} is in the air`, reach];
}

function comWords(now) {
  const {step, phase} = now;
  const moving = phase === "move";
  const verdict = moving ? data.transfers[step] : data.stances[phase === "lift" ? step + 1 : step];
  return [`COM ${point(now.com)}`, `${moving ? "least on this line: " : ""}${safety(verdict)}`];
}

function regionWords(region) {
  return [`Where the COM may be with these ${region.feet.length} feet`,
    `${region.name}: ${region.name === "R(W)" ? "stable" : "in balance"} under every disturbance of W`,
    "and within reach"];
}

/** What lies under a place of the canvas: points before lines before the region, the nearest first. */
function targetAt(x, y) {
  let best = null, least = 14;
  for (const target of targets) {
    if (!target.at) continue;
    const d = distance(target.at, [x, y]);
    if (d <= least) { best = target; least = d; }
  }
  if (best) return best;
  least = 8;
  for (const target of targets) {
    if (!target.from) continue;
    const {from, to} = target, length = distance(from, to) || 1;
    const f = clamp(((x - from[0]) * (to[0] - from[0]) + (y - from[1]) * (to[1] - from[1])) / length ** 2, 0, 1);
    const d = distance(between(from, to, f), [x, y]);
    if (d <= least) { best = target; least = d; }
  }
  return best || targets.find(target => target.region && inRegion(target.region, x, y)) || null;
}

function inRegion(region, x, y) {
  if (region.feet.some(foot => distance(camera.px(foot), [x, y]) > reachMax * camera.scale)) return false;
  let inside = false;
  for (const ring of region.rings) {
    const points = ring.map(p => camera.px(p));
    for (let i = 0, j = points.length - 1; i < points.length; j = i++) {
      const [xi, yi] = points[i], [xj, yj] = points[j];
      if ((yi > y) !== (yj > y) && x < xi + (xj - xi) * (y - yi) / (yj - yi)) inside = !inside;
    }
  }
  return inside;
}
