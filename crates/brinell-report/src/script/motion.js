// Moves the picture of the bearing through its frames. Without it the picture shows the last one.
(() => {
  const script = document.querySelector("script[data-frames]"), drawings = [...document.querySelectorAll("svg[data-motion]")];
  if (!script || !drawings.length) return;
  const motion = JSON.parse(script.textContent), count = Number(script.dataset.frames);
  const unpack = (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return Array.from({ length: bytes.length / 2 }, (_, k) => bytes[2 * k] + 256 * bytes[2 * k + 1]);
  };
  const TURN = 2 * Math.PI / 65536, ring = unpack(motion.values).map((v) => v * TURN);
  for (const row of motion.rows) {
    const n = row.pockets.length, all = unpack(row.values), part = (k) => all.slice(k * n * count, (k + 1) * n * count);
    row.n = n;
    row.orbit = part(0).map((v) => v * TURN);
    row.spin = part(1).map((v) => v * TURN);
    row.inner = part(2).map((v) => v / 65535 * motion.largest);
    row.outer = part(3).map((v) => v / 65535 * motion.largest);
    row.cage = all.slice(4 * n * count).map((v) => v * TURN);
  }
  const { inner, outer, pitch, roller, thick } = motion;
  const side = motion.section, sections = [...document.querySelectorAll("svg[data-section]")];
  if (side) {
    const signed = (v) => (v > 32767 ? v - 65536 : v) / 32767 * side.steepest;
    side.rings = unpack(side.rings).map(signed);
    for (const row of side.rows) {
      const all = unpack(row.values), loads = count * side.strips;
      row.tilt = all.slice(0, count).map(signed);
      row.outer = all.slice(count, count + loads).map((v) => v / 65535 * side.heaviest);
      row.inner = all.slice(count + loads, count + 2 * loads).map((v) => v / 65535 * side.heaviest);
    }
  }
  // The section along the axis: rings, and of each row the roller nearest to it with the load along it.
  function tilt(frame) {
    for (const svg of sections) {
      const [x, y, scale, factor, load] = svg.dataset.section.split(" ").map(Number);
      const slope = (s) => Math.min(Math.max(factor * s, -0.5), 0.5);
      const at = (z, out, s, shift = 0, up = 0) => `${(x + scale * (z + shift)).toFixed(1)} ${(y - scale * (out + slope(s) * z) - up).toFixed(1)}`;
      const closed = (points) => "M" + points.join("L") + "Z";
      const [si, so] = [side.rings[2 * frame], side.rings[2 * frame + 1]], wall = side.raceway * (1 + 2 * side.wall);
      for (const [name, s, sign] of [["t-outer", so, 1], ["t-inner", si, -1]]) {
        svg.querySelector(`.${name} path`)?.setAttribute("d", closed([at(-side.half, sign * side.raceway, s), at(side.half, sign * side.raceway, s), at(side.half, sign * wall, s), at(-side.half, sign * wall, s)]));
      }
      svg.querySelectorAll(".t-row").forEach((group, k) => {
        const row = side.rows[k], half = side.length / 2, step = side.length / side.strips, parts = group.querySelectorAll("path");
        const corner = (z, out) => at(z, out, row.tilt[frame], row.middle);
        const loads = (list, s, sign) => {
          const along = Array.from({ length: side.strips }, (_, i) => at(row.middle - half + (i + 0.5) * step, sign * side.raceway, s, 0, sign * load * list[frame * side.strips + i]));
          return closed([at(row.middle - half, sign * side.raceway, s), ...along, at(row.middle + half, sign * side.raceway, s)]);
        };
        parts[0]?.setAttribute("d", closed([corner(-half, side.raceway), corner(half, side.raceway), corner(half, -side.raceway), corner(-half, -side.raceway)]));
        parts[1]?.setAttribute("d", loads(row.outer, so, 1));
        parts[2]?.setAttribute("d", loads(row.inner, si, -1));
      });
    }
  }
  const stages = drawings.map((svg) => {
    const [scale, perNewton, ...centres] = svg.dataset.motion.split(" ").map(Number);
    const rows = [...svg.querySelectorAll(".m-row")].map((group, k) => {
      const one = (name) => group.querySelector(`.${name} path`);
      return {
        x: centres[2 * k], y: centres[2 * k + 1], ring: one("m-ring"), cage: one("m-cage"), spins: one("m-spins"), inner: one("m-inner"), outer: one("m-outer"),
        bodies: [...group.querySelectorAll(".m-bodies circle")], damage: [...group.querySelectorAll(".m-damage path")],
      };
    });
    return { svg, scale, perNewton, rows };
  });

  function show(frame) {
    if (side) tilt(frame);
    for (const { svg, scale, perNewton, rows } of stages) {
      if (svg.getBoundingClientRect().width === 0) continue;
      rows.forEach((part, k) => {
        const row = motion.rows[k], first = frame * row.n, angle = ring[frame];
        const at = (radius, a) => `${(part.x + scale * radius * Math.cos(a)).toFixed(1)} ${(part.y - scale * radius * Math.sin(a)).toFixed(1)}`;
        const line = (points) => "M" + points.join("L");
        part.ring?.setAttribute("d", line([at(Math.max(inner - thick, 0.2 * inner), angle), at(inner, angle)]));
        const half = Math.max(Math.PI / row.n - 1.06 * Math.asin(Math.min(roller / pitch, 1)), 0.006);
        part.cage?.setAttribute("d", row.pockets.map((p) => { const middle = p + row.cage[frame] + Math.PI / row.n; return line([-half, 0, half].map((a) => at(pitch, middle + a))); }).join(""));
        let spins = "", inwards = "", outwards = "";
        part.bodies.forEach((body, j) => {
          const a = row.orbit[first + j], s = row.spin[first + j], x = part.x + scale * pitch * Math.cos(a), y = part.y - scale * pitch * Math.sin(a);
          body.setAttribute("cx", x.toFixed(1));
          body.setAttribute("cy", y.toFixed(1));
          spins += `M${x.toFixed(1)} ${y.toFixed(1)}l${(0.85 * scale * roller * Math.cos(s)).toFixed(1)} ${(-0.85 * scale * roller * Math.sin(s)).toFixed(1)}`;
          const qi = row.inner[first + j], qo = row.outer[first + j];
          if (qi > 0) inwards += line([at(inner, a), at(inner - qi * perNewton / scale, a)]);
          if (qo > 0) outwards += line([at(outer, a), at(outer + qo * perNewton / scale, a)]);
        });
        part.spins?.setAttribute("d", spins);
        part.inner?.setAttribute("d", inwards);
        part.outer?.setAttribute("d", outwards);
        motion.damage.filter((d) => d[0] === k).forEach(([, kind, from, to, j], index) => {
          const along = Array.from({ length: 9 }, (_, i) => from + i / 8 * (to - from)), path = part.damage[index];
          if (!path || kind === "outer") return;
          if (kind === "inner") path.setAttribute("d", line(along.map((a) => at(inner, a + angle))));
          else if (j < row.n) {
            const a = row.orbit[first + j], s = row.spin[first + j], x = part.x + scale * pitch * Math.cos(a), y = part.y - scale * pitch * Math.sin(a);
            path.setAttribute("d", line(along.map((b) => `${(x + scale * roller * Math.cos(b + s)).toFixed(1)} ${(y - scale * roller * Math.sin(b + s)).toFixed(1)}`)));
          }
        });
      });
    }
  }

  const RATE = 30, figure = drawings[0].closest("figure"), bar = document.createElement("div");
  const play = document.createElement("button"), slider = document.createElement("input"), pace = document.createElement("select"), told = document.createElement("output");
  bar.className = "tools motion-tools";
  play.type = "button";
  Object.assign(slider, { type: "range", min: 0, max: count - 1, step: 1, value: count - 1, title: "Instant shown" });
  slider.setAttribute("aria-label", "Instant shown");
  pace.setAttribute("aria-label", "Pace");
  for (const p of [1, 0.5, 0.25]) {
    const slower = 1 / (motion.dt * RATE * p), option = document.createElement("option");
    option.value = p;
    option.textContent = slower >= 1 ? `${Number(slower.toPrecision(2))} × slower than real` : `${Number((1 / slower).toPrecision(2))} × faster than real`;
    pace.append(option);
  }
  bar.append(play, slider, pace, told);
  drawings[drawings.length - 1].after(bar);

  let frame = count - 1, playing = false, wanted = null, last = 0, carry = 0, visible = false;
  const tell = () => {
    slider.value = frame;
    told.textContent = `t = ${(motion.t0 + frame * motion.dt).toFixed(5)} s`;
    play.textContent = playing ? "Pause" : "Play";
    figure.dataset.frame = frame;
  };
  const go = (to) => { frame = ((to % count) + count) % count; show(frame); tell(); };
  const tick = (now) => {
    if (!playing) return;
    carry += Math.min(now - last, 250) / 1000 * RATE * Number(pace.value);
    last = now;
    const whole = Math.floor(carry);
    carry -= whole;
    if (whole > 0) go(frame + whole);
    requestAnimationFrame(tick);
  };
  const set = (on) => {
    if (on === playing) return;
    playing = on;
    tell();
    if (on) { last = performance.now(); carry = 0; requestAnimationFrame(tick); }
  };
  play.addEventListener("click", () => { wanted = !playing; set(wanted); });
  slider.addEventListener("input", () => { wanted = false; set(false); go(Number(slider.value)); });
  addEventListener("resize", () => show(frame));
  addEventListener("beforeprint", () => { set(false); stages.forEach((s) => s.svg.style.display = ""); });
  // Plays by itself while it is in view, unless the reader requested less motion or paused it.
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const decide = () => set(visible && (wanted ?? !calm.matches));
  if ("IntersectionObserver" in window) new IntersectionObserver((entries) => { visible = entries[entries.length - 1].isIntersecting; decide(); }, { threshold: 0.3 }).observe(figure);
  calm.addEventListener?.("change", decide);
  tell();
})();
