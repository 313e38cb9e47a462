// Time, keys, buttons, the pointer, the words beside the picture, and the address (#step=3, #t=2.5&play&view=follow).
const element = id => document.getElementById(id);
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const secondsPerStep = 2;  // at speed 1

const state = {t: 0, playing: false, run: 0, speed: 1, last: 0, wait: 0, pointer: null};

function seek(t, say = true) {
  state.t = clamp(Number.isFinite(t) ? t : 0, 0, steps);
  state.wait = 0;
  show();
  if (say) element("say").textContent = `${element("step").textContent}: ${element("phase").textContent}`;
}

const forward = () => seek(Math.floor(state.t) + 1);
const back = () => seek(Math.ceil(state.t) - 1);

/** The next or previous beginning of a part of a step. */
function partBy(direction) {
  const marks = [0, ...phases.map(phase => phase.end)], k = Math.floor(state.t), slack = 1e-9;
  const times = [k - 1, k, k + 1].flatMap(step => marks.map(mark => step + mark));
  const next = times.filter(t => direction * (t - state.t) > slack);
  if (direction < 0) next.reverse();
  seek(next.length ? next[0] : state.t);
}

function play(on) {
  state.playing = on && steps > 0;
  if (state.playing && state.t >= steps) state.t = 0;
  state.last = 0; state.wait = 0;
  element("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
  element("play").title = `${state.playing ? "Pause" : "Play"} (space)`;
  element("play").classList.toggle("playing", state.playing);
  const run = ++state.run;  // a frame still to come from an earlier one is void
  if (state.playing) requestAnimationFrame(now => tick(now, run));
  else seek(state.t);
}

/** One frame. Who asked for reduced motion sees the parts of a step one after the other, without movement. */
function tick(now, run) {
  if (!state.playing || run !== state.run) return;
  const passed = state.last ? Math.min(now - state.last, 250) / 1000 : 0;
  state.last = now;
  const ahead = passed * state.speed / secondsPerStep;
  if (calm.matches) {
    state.wait += ahead;
    if (state.wait >= 1 / phases.length) { partBy(1); state.wait = 0; }
  } else {
    state.t = Math.min(steps, state.t + ahead);
    show();
  }
  if (state.t >= steps) play(false);
  else requestAnimationFrame(next => tick(next, run));
}

const set = (id, text) => { if (element(id).textContent !== text) element(id).textContent = text; };

/** Everything that depends on the time. */
function show() {
  const now = pose(state.t);
  draw(now);
  drawStrip(state.t);
  hover();
  element("time").value = state.t;
  element("time").setAttribute("aria-valuetext", element("step").textContent);
  if (!now) return;
  const {step, phase} = now, transfer = plan.transfers[step];
  set("step", stanceName(step));
  set("phase", phaseWords(now));
  set("at-com", point(now.com));
  for (const row of document.querySelectorAll(".of-step")) row.hidden = !transfer;
  set("stance", data.stances[step].factor);
  set("stance-why", data.stances[step].why);
  element("stance-row").classList.toggle("now", phase !== "move" && phase !== "lift");
  if (!transfer) return;
  const {place: {leg, foothold}, lift} = transfer, {from} = data.stances[step].free || {};
  set("placed", `leg ${leg}`);
  set("from-to", `${from ? point(place(from)) : "in the air"} → ${point(place(foothold))}`);
  set("com", `${point(plan.stances[step].com)} → ${point(plan.stances[step + 1].com)}`);
  set("lifted", `leg ${lift}`);
  set("transfer", data.transfers[step].factor);
  set("transfer-why", data.transfers[step].why);
  element("transfer-row").classList.toggle("now", phase === "move");
}

function hover() {
  const tip = element("tip"), at = state.pointer;
  if (!at) { tip.hidden = true; return; }
  const box = at.on.getBoundingClientRect(), x = at.x - box.left, y = at.y - box.top;
  const target = at.on === canvas ? targetAt(x, y) : {words: () => barWords(x)};
  const words = target ? target.words() : [];
  canvas.style.cursor = target && target.t !== undefined ? "pointer" : "default";
  tip.hidden = !words.length;
  if (tip.hidden) return;
  tip.replaceChildren(...words.map(text => Object.assign(document.createElement("div"), {textContent: text})));
  const width = document.documentElement.clientWidth;
  tip.style.left = `${clamp(at.x + 14, 4, Math.max(4, width - tip.offsetWidth - 4))}px`;
  tip.style.top = `${at.y + 18 + tip.offsetHeight > innerHeight ? at.y - tip.offsetHeight - 10 : at.y + 18}px`;
}

function view(whole, zoom) {
  camera.whole = whole;
  camera.zoom = clamp(zoom, 0.2, 20);
  element("view").textContent = whole ? "Follow" : "Whole way";
  show();
}

function setSpeed(speed) {
  const options = [...element("speed").options].map(option => Number(option.value));
  state.speed = options.includes(speed) ? speed : 1;
  element("speed").value = String(state.speed);
}

function otherSpeed(by) {
  const options = [...element("speed").options].map(option => Number(option.value));
  setSpeed(options[clamp(options.indexOf(state.speed) + by, 0, options.length - 1)]);
}

const weakestTime = () => data.weakest ? data.weakest.index + (data.weakest.in_transfer ? touchDown : 0) : 0;

const keys = {
  " ": () => play(!state.playing), k: () => play(!state.playing),
  ArrowRight: event => event.shiftKey ? partBy(1) : forward(),
  ArrowLeft: event => event.shiftKey ? partBy(-1) : back(),
  Home: () => seek(0), End: () => seek(steps), w: () => seek(weakestTime()),
  "+": () => view(camera.whole, camera.zoom * 1.25), "-": () => view(camera.whole, camera.zoom / 1.25),
  0: () => view(camera.whole, 1), v: () => view(!camera.whole, 1),
  "[": () => otherSpeed(-1), "]": () => otherSpeed(1),
  "?": () => { element("help").open = !element("help").open; element("help").scrollIntoView({block: "nearest"}); },
};

document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === "SELECT") return;
  if (event.key === " " && ["BUTTON", "SUMMARY"].includes(event.target.tagName)) return;  // pressed by the browser
  const act = keys[event.key];
  if (!act) return;
  event.preventDefault();
  if (event.key.startsWith("Arrow") && state.playing) play(false);
  act(event);
});

const onClick = (id, act) => element(id).addEventListener("click", act);
onClick("first", keys.Home);
onClick("back", () => { play(false); back(); });
onClick("play", keys[" "]);
onClick("forward", () => { play(false); forward(); });
onClick("last", keys.End);
onClick("weakest", keys.w);
onClick("view", keys.v);
onClick("closer", keys["+"]);
onClick("farther", keys["-"]);
element("speed").addEventListener("change", () => setSpeed(Number(element("speed").value)));
element("time").addEventListener("input", () => seek(Number(element("time").value), false));

for (const on of [canvas, strip]) {
  on.addEventListener("pointermove", event => {
    state.pointer = {on, x: event.clientX, y: event.clientY};
    if (on === strip && event.buttons) seek(stripTime(event.offsetX), false);
    else hover();
  });
  on.addEventListener("pointerleave", () => { state.pointer = null; hover(); });
}
strip.addEventListener("pointerdown", event => {
  strip.setPointerCapture(event.pointerId);
  seek(stripTime(event.offsetX), false);
});
canvas.addEventListener("click", event => {
  state.pointer = {on: canvas, x: event.clientX, y: event.clientY};
  const target = targetAt(event.offsetX, event.offsetY);
  if (target && target.t >= 0) seek(target.t);
  else hover();
});
canvas.addEventListener("wheel", event => {
  if (!event.ctrlKey && !event.shiftKey) return;  // the wheel alone scrolls the page
  event.preventDefault();
  view(camera.whole, camera.zoom * Math.exp(-event.deltaY / 400));
}, {passive: false});

/** The table is made when it is asked for: it may have many rows. */
element("table").addEventListener("toggle", () => {
  const body = element("rows");
  if (!element("table").open || body.childElementCount) return;
  plan.stances.forEach((stance, k) => {
    const transfer = plan.transfers[k], row = body.insertRow();
    const button = Object.assign(document.createElement("button"), {textContent: k < steps ? k + 1 : "end"});
    button.addEventListener("click", () => seek(k));
    button.setAttribute("aria-label", k < steps ? `Go to step ${k + 1}` : "Go to the end");
    row.insertCell().append(button);
    const {from} = data.stances[k].free || {};
    const placed = transfer
      ? [transfer.place.leg, from ? point(place(from)) : "in the air", point(place(transfer.place.foothold))]
      : ["", "", ""];
    const moved = transfer ? [data.transfers[k].factor, data.transfers[k].why] : ["", ""];
    for (const text of [...placed, Object.keys(stance.feet).join(" "), point(stance.com), transfer ? transfer.lift : "",
      data.stances[k].factor, data.stances[k].why, ...moved]) row.insertCell().textContent = text;
  });
});

function fillIn() {
  set("title", data.title);
  const {kappa, nu} = data.scene;
  set("about", plan.reason || `Disturbances: sideways up to ${kappa} of the weight, torques up to the weight times ` +
    `${Number(nu.toPrecision(6))} m. A safety factor of 2 withstands twice these.`);
  element("weakest").hidden = !data.weakest;
  if (data.weakest) set("weakest", `Weakest${data.faults.length ? " as stated" : ""}: ${data.weakest.factor} in ${data.weakest.place}`);
  element("time").max = steps;
  for (const {grip, words} of data.terrain.legend) {
    const item = document.createElement("li"), swatch = document.createElement("i");
    swatch.className = `line ${grip}`;
    item.append(swatch, words);
    element("legend").append(item);
  }
  element("region-name").textContent = data.scene.stance_region === data.scene.region ? data.scene.region
    : `${data.scene.stance_region} of stances, ${data.scene.region} of transfers`;
  element("clearance").hidden = !(data.scene.clearance > 0);
  element("faults").hidden = !data.faults.length;
  for (const fault of data.faults.slice(0, 50))
    element("fault-list").append(Object.assign(document.createElement("li"), {textContent: fault}));
}

function goToAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  if (asked.has("speed")) setSpeed(Number(asked.get("speed")));
  if (asked.has("view")) view(asked.get("view") === "whole", 1);
  seek(asked.has("step") ? Number(asked.get("step")) - 1 : Number(asked.get("t") || 0));
  if (asked.has("play")) play(true);
}

function redraw() {
  readColours();
  nearby.window = null;
  paintBars();
  show();
}

readColours();
fillIn();
camera.width = canvas.clientWidth; camera.height = canvas.clientHeight;
const readable = 60;  // px that a reach should have
view(camera.wholeScale() * reachMax >= readable, 1);
new ResizeObserver(redraw).observe(canvas);
dark.addEventListener("change", redraw);
window.addEventListener("hashchange", goToAddress);
redraw();
goToAddress();
window.surefoot = {data, pose, seek, play, state, camera};  // for scripts: surefoot.pose(2.5) is what is drawn then
document.documentElement.dataset.ready = "yes";
