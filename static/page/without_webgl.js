// A browser without WebGL (switched off, no driver, a remote desktop) shows everything but the robot, and says so.
//
// The client reads the server's messages in the render loop of its 3D area, and without a WebGL context there would be
// no such loop: it would stay empty and say "Connected". So it is given a context that draws nothing. It asks for no
// extension, and what it makes are names without anything behind them; the numbers are what a weak GPU has.
(() => {
  const NUMBER = 4096; // sizes and counts of every kind
  const constants = window.WebGL2RenderingContext || {};
  const answers = {
    getContextAttributes: () => ({alpha: true, depth: true, antialias: false, premultipliedAlpha: true}),
    getSupportedExtensions: () => [],
    getExtension: () => null,
    getShaderPrecisionFormat: () => ({precision: 23, rangeMin: 127, rangeMax: 127}),
    getShaderInfoLog: () => "",
    getProgramInfoLog: () => "",
    getProgramParameter: () => 0, // a program has no uniforms and no attributes
    getAttribLocation: () => -1,
    getError: () => 0,
    checkFramebufferStatus: () => constants.FRAMEBUFFER_COMPLETE,
    isContextLost: () => false,
    getParameter: (name) => {
      if (name === constants.VERSION) return "WebGL 2.0 (draws nothing)";
      if (name === constants.SHADING_LANGUAGE_VERSION) return "WebGL GLSL ES 3.00 (draws nothing)";
      if (name === constants.SCISSOR_BOX || name === constants.VIEWPORT) return new Int32Array(4);
      return NUMBER;
    },
  };

  function blindContext(canvas) {
    const own = {canvas, drawingBufferColorSpace: "srgb", ...answers};
    return new Proxy(own, {
      get(known, name) {
        if (name in known) return known[name];
        if (name === "drawingBufferWidth") return canvas.width;
        if (name === "drawingBufferHeight") return canvas.height;
        if (typeof name !== "string" || name === "then") return undefined;
        if (/^[A-Z0-9_]+$/.test(name)) return constants[name];
        return (known[name] = name.startsWith("create") ? () => ({}) : () => undefined);
      },
    });
  }

  function notice() {
    const cover = document.createElement("div");
    cover.setAttribute("role", "status");
    cover.setAttribute("aria-label", "Why there is no 3D view");
    cover.style.cssText = "position:absolute;inset:0;z-index:10;display:grid;place-items:center;overflow:auto;" +
      "font:15px/1.45 system-ui,sans-serif;background:var(--mantine-color-body,#fff);" +
      "color:var(--mantine-color-text,#1a1b1e);cursor:auto";
    cover.innerHTML = `<div style="max-width:30em;padding:12px 16px">
      <b>The 3D view needs WebGL, which this browser does not give.</b>
      <p>Controls, readings, log and plots work as usual; only the robot is not drawn.</p>
      <ul style="padding-left:1.2em">
      <li>Chrome, Edge: Settings, System, "Use graphics acceleration when available", then start the browser again;
      <code>chrome://gpu</code> says what is missing.</li>
      <li>Firefox: <code>about:config</code>, <code>webgl.disabled</code> must be false; <code>about:support</code>
      says what is missing.</li>
      <li>A graphics driver that is up to date, or this address in another browser or on another machine.</li>
      </ul>
      <p>Without a page: <code>surefoot run stand_left</code>; <code>surefoot --help</code> lists all.</p></div>`;
    // what is not seen is not clicked: stones would be put, and links pulled, in a scene that nobody sees
    for (const kind of ["pointerdown", "pointermove", "pointerup", "click", "dblclick", "wheel", "contextmenu"]) {
      cover.addEventListener(kind, (event) => event.stopPropagation());
    }
    return cover;
  }

  const blind = new WeakMap(); // canvas -> its context that draws nothing
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = original.call(this, kind, ...rest);
    if (context || kind !== "webgl2") return context;
    if (!blind.has(this)) {
      blind.set(this, blindContext(this));
      // a canvas that only asks whether there is WebGL stands nowhere
      if (this.parentElement) this.parentElement.append(notice());
    }
    return blind.get(this);
  };
})();
