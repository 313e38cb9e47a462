// Put at the end of a page made by `surefoot ... --html`, looks whether it does what it should, and leaves its findings
// in the attribute data-checks of the document: how many passed, or what failed. What it expects of the motion it works
// out from the plan and the rules, with nothing of the page but surefoot.pose().
(async () => {
  const failures = [];
  let count = 0;
  const check = (holds, what) => { ++count; if (!holds && failures.length < 20) failures.push(what); };
  const text = id => document.getElementById(id).textContent;
  const wait = seconds => new Promise(resolve => setTimeout(resolve, 1000 * seconds));
  const key = (name, more = {}) =>
    document.body.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true, ...more}));
  const point = (on, box, [x, y]) =>
    on.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left + x, clientY: box.top + y, bubbles: true}));
  const {data, pose, seek, play, state, camera} = window.surefoot;
  const preferences = {dark: "(prefers-color-scheme: dark)", calm: "(prefers-reduced-motion: reduce)"};
  const {stances, transfers} = data.plan, steps = transfers.length;
  const [least, greatest] = data.scene.reach;
  const spot = foot => [foot.x, foot.y];
  const far = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
  const cross = (o, p, q) => (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
  const near = 1e-9 * greatest;
  const onLine = (p, a, b) => Math.abs(far(a, p) + far(p, b) - far(a, b)) < near;
  const walls = data.terrain.surface.flatMap(({points}) => points.slice(1).map((p, i) => [points[i], p]));
  // By brute force; the last fiftieth of a leg may touch the ground it comes from or goes to.
  const isFree = (com, tip) => {
    const end = [com[0] + 0.98 * (tip[0] - com[0]), com[1] + 0.98 * (tip[1] - com[1])];
    const apart = (p, q, a, b) => cross(p, q, a) * cross(p, q, b) < 0;
    return !walls.some(([a, b]) => apart(com, end, a, b) && apart(a, b, com, end));
  };
  const leg = (now, which) => now.legs.find(one => one.leg === which);

  function motion() {
    const last = {...data.scene.start};  // where each leg stood last
    for (let k = 0; k <= steps; ++k) {
      Object.assign(last, stances[k].feet);
      const rest = pose(k), where = `stance ${k + 1}`;
      check(far(rest.com, stances[k].com) < near, `${where}: COM`);
      check(rest.legs.every(one => one.carries === (String(one.leg) in stances[k].feet)), `${where}: legs that carry`);
      if (k < steps) transfer(k, last);
    }
  }

  function transfer(k, last) {
    const {place: {leg: placed, foothold}, lift} = transfers[k], where = `step ${k + 1}`;
    const from = stances[k].com, to = stances[k + 1].com;
    let before = pose(k), touched = false, lifting = false;
    const parts = 240;
    for (let i = 0; i <= parts; ++i) {
      const now = i < parts ? pose(k + i / parts) : pose(k + 1 - 1e-12);
      const free = leg(now, placed), lifted = leg(now, lift), carrying = now.legs.filter(one => one.carries).length;
      check(onLine(now.com, from, to), `${where}: the COM leaves its line`);
      check(now.legs.every(one => !one.carries || far(one.tip, spot(one.foot)) < near), `${where}: a foot slips`);
      check(now.legs.every(one => one.carries ? far(now.com, one.tip) <= greatest + near : true), `${where}: reach`);
      check(now.legs.every((one, n) => far(one.tip, before.legs[n].tip) < 0.1 * greatest), `${where}: a leg jumps`);
      check(now.legs.every(one => one.carries || isFree(now.com, one.tip)), `${where}: a leg in the air cuts terrain`);
      check(carrying === (now.phase === "move" ? 3 : 2), `${where}: ${carrying} legs carry`);
      if (now.phase === "turn") {
        check(far(now.com, from) < near && Math.abs(far(now.com, free.tip) - least) < near, `${where}: turn`);
        // A leg that starts in the air may do so from nearer than it reaches.
        const stood = i === 0 && last[placed] ? spot(last[placed]) : null;
        check(!stood || onLine(free.tip, from, stood) || far(from, stood) < least, `${where}: turns from elsewhere`);
      } else if (now.phase === "place") {
        check(far(now.com, from) < near && onLine(free.tip, from, spot(foothold)), `${where}: touch-down`);
      } else if (now.phase === "move") {
        touched = touched || far(free.tip, spot(foothold)) < near;
      } else {
        lifting = true;
        const foot = lift === placed ? foothold : stances[k].feet[lift];
        check(far(now.com, to) < near && onLine(lifted.tip, to, spot(foot)), `${where}: lift-off`);
      }
      before = now;
    }
    check(touched && lifting, `${where}: parts are missing`);
    check(before.legs.every((one, n) => far(one.tip, pose(k + 1).legs[n].tip) < 1e-6 * greatest), `${where}: end`);
  }

  function controls() {
    seek(0);
    check(text("step") === `Step 1 of ${steps}`, `begins with '${text("step")}'`);
    key("ArrowRight"); key("ArrowRight");
    check(text("step") === `Step 3 of ${steps}`, `two steps on: '${text("step")}'`);
    key("ArrowLeft");
    check(text("step") === `Step 2 of ${steps}`, `one back: '${text("step")}'`);
    key("ArrowRight", {shiftKey: true});
    check(text("phase").includes("reaches"), `a part of a step on: '${text("phase")}'`);
    check(document.getElementById("time").value > 1, "the time bar follows");
    key("ArrowLeft"); key("ArrowLeft"); key("ArrowLeft");
    check(text("step") === `Step 1 of ${steps}`, "goes back no further than the first stance");
    key("End");
    check(text("step").startsWith("End after"), `at the end: '${text("step")}'`);
    const [x, y] = pose(state.t).com, {com_x, com_y} = data.scene.goal;
    check((!com_x || (x >= com_x[0] && x <= com_x[1])) && (!com_y || (y >= com_y[0] && y <= com_y[1])), "the goal");
    document.getElementById("back").click();
    check(text("step") === `Step ${steps} of ${steps}`, `the button steps back: '${text("step")}'`);
    key("w");
    check(text("step").includes(String(data.weakest.index + 1)) || data.weakest.index === steps, "the weakest place");
    document.getElementById("help").open = true;
    check(document.getElementById("help").getBoundingClientRect().height > 100, "help is shown");
  }

  function drawing() {
    const t = 0.6;  // on the way to the second stance: no mark of a stance lies there
    seek(t);
    const canvas = document.getElementById("stage"), box = canvas.getBoundingClientRect();
    const pen = canvas.getContext("2d"), ratio = canvas.width / box.width;
    const at = camera.px(pose(t).com);
    const pixel = (x, y) => [...pen.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data].slice(0, 3);
    const dark = matchMedia(preferences.dark).matches, sky = pixel(3, 3);
    const around = i => pixel(at[0] + 7 * Math.cos(i * Math.PI / 12), at[1] + 7 * Math.sin(i * Math.PI / 12));
    const ring = [...Array(24).keys()].map(around);
    const body = ring.filter(([r, g, b]) => dark ? Math.min(r, g, b) > 200 : Math.max(r, g, b) < 80).length;
    check(body >= 16, `the COM is drawn: ${body} of 24 pixels around it`);
    check(Math.max(...sky) < 80 === dark || data.terrain.ground.length > 1, `the sky: ${sky}, dark: ${dark}`);
    point(canvas, box, at);
    const tip = document.getElementById("tip");
    const told = "safety factor " + data.transfers[0].factor;
    check(!tip.hidden && tip.textContent.includes(told), `hint at the COM: '${tip.textContent}'`);
    const foot = Object.values(stances[0].feet)[0], stands = camera.px(spot(foot));
    point(canvas, box, stands);
    check(/^Leg \d.*friction/.test(tip.textContent), `hint at a foot: '${tip.textContent}'`);
    canvas.dispatchEvent(new PointerEvent("pointerleave"));
    check(tip.hidden, "the hint goes");
  }

  async function playing() {
    const calm = matchMedia(preferences.calm).matches, begin = Math.max(0, steps - 3);
    seek(begin);
    document.getElementById("speed").value = "4";
    document.getElementById("speed").dispatchEvent(new Event("change"));
    play(true);
    check(document.getElementById("play").getAttribute("aria-label") === "Pause", "the button pauses");
    const seen = new Set();
    for (let i = 0; i < 400 && state.playing; ++i) { await wait(0.02); seen.add(state.t); }
    check(!state.playing && state.t === steps, `plays to the end: ${state.t}`);
    const shown = seen.size / (steps - begin);  // four parts of a step, or many pictures
    check(calm ? shown < 5 : shown > 8, `${shown} pictures for a step, calm: ${calm}`);
  }

  async function table() {
    document.getElementById("table").open = true;
    await wait(0.1);
    const rows = document.querySelectorAll("#rows tr");
    check(rows.length === steps + 1, `${rows.length} rows`);
    rows.forEach((row, k) => check(row.textContent.includes(data.stances[k].factor), `row ${k + 1}`));
  }

  try {
    check(document.documentElement.dataset.ready === "yes", "the page is ready");
    // The address says what the browser was told to prefer, or the run would not test it.
    for (const [word, query] of Object.entries(preferences))
      check(matchMedia(query).matches === location.hash.includes(word), `preference ${word}`);
    motion();
    controls();
    drawing();
    await playing();
    await table();
    check(document.getElementById("error").hidden, `error: ${text("error")}`);
    check(performance.getEntriesByType("resource").length === 0, "something was loaded");
  } catch (fault) {
    failures.push(`${fault}`);
  }
  document.documentElement.dataset.checks = failures.length ? "FAILED: " + failures.join("; ") : `passed ${count}`;
})();
