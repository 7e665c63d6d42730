"use strict";
(() => {
  const { figures, drawing } = JSON.parse(document.getElementById("data").textContent);
  const config = {
    responsive: true,
    displaylogo: false,
    modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg" },
  };
  const plots = [];

  for (const div of document.querySelectorAll("[data-figure]")) {
    const { data, layout } = figures[Number(div.dataset.figure)];
    Plotly.newPlot(div, data, layout, config);
    plots.push(div);
  }
  if (drawing) draw(drawing);

  // on paper every plot takes the width of the page
  const resize = () => plots.forEach((div) => Plotly.Plots.resize(div));
  window.addEventListener("beforeprint", resize);
  window.addEventListener("afterprint", resize);

  function floats(packed) {
    const bytes = Uint8Array.from(atob(packed.bdata), (c) => c.charCodeAt(0));
    return new Float32Array(bytes.buffer);
  }

  function draw({ data, layout, moving, labels, captions, scale }) {
    const element = (id) => document.getElementById(id);
    const [plot, slider, play] = ["drawing-plot", "angle", "play"].map(element);
    const tracks = moving.map((m) => ({ ...m, x: floats(m.x), y: floats(m.y) }));
    const traces = moving.map((m) => m.trace);
    const part = (track, axis, i) => track[axis].subarray(i * track.size, (i + 1) * track.size);
    const last = labels.length - 1;
    let timer = null;

    function show(i) {
      element("angle-label").textContent = labels[i];
      element("drawing-caption").textContent = captions[i];
      if (!traces.length) return null;
      const update = { x: tracks.map((t) => part(t, "x", i)), y: tracks.map((t) => part(t, "y", i)) };
      update.text = tracks.map((t) => (t.text.length ? t.text[i] : ""));
      return Plotly.restyle(plot, update, traces);
    }
    function pause() {
      clearTimeout(timer);
      timer = null;
      play.textContent = "▶";
    }
    async function step() {
      slider.value = Number(slider.value) < last ? Number(slider.value) + 1 : 0;
      await show(Number(slider.value));
      if (timer !== null) timer = setTimeout(step, 90);
    }

    slider.max = last;
    slider.closest(".control").hidden = last === 0;
    slider.addEventListener("input", () => show(Number(slider.value)));
    play.addEventListener("click", () => {
      if (timer !== null) return pause();
      play.textContent = "❚❚";
      timer = setTimeout(step, 0);
    });
    element("drawing-scale").textContent = scale;
    Plotly.newPlot(plot, data, layout, config);
    plots.push(plot);
    show(0);
  }
})();
