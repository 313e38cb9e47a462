// Where body and legs are at a time. Time t counts steps: t = k is stance k at rest (from 0), its free leg drawn in.
// Between k and k + 1 lies transfer k, the motion whose parts the rules of gaits/rules.hpp check:
//   turn   the free leg, as short as reach allows, turns about the COM from the old foot's direction to the new one's
//   place  it reaches out along a straight line to the new foothold: touch-down
//   move   the COM goes straight to its next place on three feet
//   lift   the leg to be lifted is drawn in along a straight line: lift-off
// Only how long each part takes is the player's choice.
const data = JSON.parse(document.getElementById("data").textContent);
const plan = data.plan;
const steps = Math.max(0, Math.min(plan.transfers.length, plan.stances.length - 1));
const [reachMin, reachMax] = data.scene.reach;
const phases = [
  {name: "turn", end: 0.25}, {name: "place", end: 0.42}, {name: "move", end: 0.85}, {name: "lift", end: 1}];
const touchDown = phases[1].end;
const legs = [1, 2, 3];

const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
const mix = (a, b, f) => a + (b - a) * f;
const between = (p, q, f) => [mix(p[0], q[0], f), mix(p[1], q[1], f)];
const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
const bearing = (p, q) => Math.atan2(q[1] - p[1], q[0] - p[0]);
const smooth = f => f * f * (3 - 2 * f);
const place = foot => [foot.x, foot.y];

/** The point of a leg `length` long in direction `angle` from the COM. */
const tip = (com, angle, length) => [com[0] + length * Math.cos(angle), com[1] + length * Math.sin(angle)];

/** Direction of the free leg of stance k: from where it was lifted or, if it never stood, where it will. */
function restingAngle(k) {
  const com = plan.stances[k].com, free = data.stances[k].free;
  if (free && free.from) return bearing(com, place(free.from));
  return k < steps ? bearing(com, place(plan.transfers[k].place.foothold)) : -Math.PI / 2;
}

/** The angle of the turn before transfer k; where the rules found no free way, the shorter one. */
function turnOf(k) {
  const turn = data.transfers[k].turn;
  if (turn !== undefined && turn !== null) return turn;
  if (turn === undefined) return 0;
  const angle = bearing(plan.stances[k].com, place(plan.transfers[k].place.foothold)) - restingAngle(k);
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

/** Step, part of it and how much of the part is done; step `steps` is the last stance. */
function moment(t) {
  const step = clamp(Math.floor(t), 0, steps), within = clamp(t - step, 0, 1);
  if (step >= steps) return {step: steps, phase: "end", done: 0};
  let begin = 0;
  for (const {name, end} of phases) {
    if (within < end) return {step, phase: name, done: (within - begin) / (end - begin)};
    begin = end;
  }
  return {step, phase: "lift", done: 1};
}

/** Everything that is drawn of the robot: {step, phase, com, legs: [{leg, tip, foot, carries}]}. `foot` is the foothold
    that the leg stands on, comes from or goes to. */
function pose(t) {
  if (!plan.stances.length) return null;
  const {step, phase, done} = moment(t);
  const stance = plan.stances[step], next = plan.stances[step + 1], transfer = plan.transfers[step];
  const f = smooth(done);
  const com = phase === "move" ? between(stance.com, next.com, f) : phase === "lift" ? next.com : stance.com;
  const result = {t, step, phase, com, legs: []};
  for (const leg of legs) {
    let foot = stance.feet[leg];
    if (transfer && phase === "lift" && leg === transfer.lift) {
      foot = foot || transfer.place.foothold;
      const length = mix(distance(com, place(foot)), reachMin, f);
      result.legs.push({leg, foot, tip: tip(com, bearing(com, place(foot)), length), carries: false});
    } else if (foot) {
      result.legs.push({leg, foot, tip: place(foot), carries: true});
    } else if (transfer && leg === transfer.place.leg) {
      result.legs.push(freeLeg(step, phase, f, com, transfer));
    } else {  // at the end: a foot that never was lifted may be nearer than reach allows
      const {from} = data.stances[step].free || {};
      const length = from ? Math.min(reachMin, distance(com, place(from))) : reachMin;
      result.legs.push({leg, foot: from, tip: tip(com, restingAngle(step), length), carries: false});
    }
  }
  return result;
}

/** The leg placed by a transfer, before and after it touches down. */
function freeLeg(step, phase, f, com, transfer) {
  const leg = transfer.place.leg, foot = transfer.place.foothold, target = place(foot);
  if (phase === "turn")
    return {leg, foot, tip: tip(com, restingAngle(step) + f * turnOf(step), reachMin), carries: false};
  if (phase === "place") {
    const length = mix(reachMin, distance(com, target), f);
    return {leg, foot, tip: tip(com, bearing(com, target), length), carries: false};
  }
  return {leg, foot, tip: target, carries: true};
}

/** Where the COM may be at that moment: data of the stance or transfer with {rings, feet, name}. */
function regionAt(now) {
  const {step, phase} = now;
  const moving = phase === "move";
  const k = phase === "lift" ? step + 1 : step;
  const feet = now.legs.filter(leg => leg.carries).map(leg => place(leg.foot));
  return {key: (moving ? "m" : "s") + k, rings: (moving ? data.transfers : data.stances)[k].region, feet,
    name: moving ? data.scene.region : data.scene.stance_region};
}
