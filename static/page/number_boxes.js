// Number boxes of the page: what is typed is sent when it is finished, with Enter or by leaving the box. A comma is a
// decimal point. What is no number, or out of the slider's range, is said beside the box, and the old value stays.
//
// The client would take every key for a value (on the way to 120 also 1 and 12), and would put what is out of range
// to the nearest end of it. So the "input" events of number boxes are held back from it, in the capture phase, until
// the text is finished; then one of them is let through. And it goes on to write the value of a box that follows the
// run: in a box that a person has entered it must not, or it would take away what is selected there, or the next key
// would go into another text than the person saw. There it writes and reads a text of its own, which is shown when the
// person is done.
(() => {
  const SHOWN_MS = 4000;
  const held = new WeakMap(); // box that a person has entered -> the client's text, and whether the person typed
  let finished = false;

  const isNumberBox = (target) =>
    target instanceof HTMLInputElement && target.classList.contains("mantine-NumberInput-input");

  // the text on the screen, past what the client's library and "hold" put on the element
  const { get: textOf, set: write } = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value");

  // The client passes a text on, no number, that ends in a zero of its fraction: 4.0 or 12.50; and it knows no exponent.
  const plain = (value) => (String(value).includes("e") ? value.toFixed(12).replace(/\.?0+$/, "") : String(value));

  function rangeOf(box) {
    for (let row = box.parentElement, up = 0; row && up < 3; row = row.parentElement, up += 1) {
      const slider = row.querySelector("[role=slider]");
      if (slider) return [Number(slider.getAttribute("aria-valuemin")), Number(slider.getAttribute("aria-valuemax"))];
    }
    return [-Infinity, Infinity];
  }

  function refuse(box, reason) {
    const note = document.createElement("div");
    const place = box.getBoundingClientRect();
    note.setAttribute("role", "alert");
    note.textContent = reason;
    Object.assign(note.style, {
      position: "fixed", right: `${window.innerWidth - place.right}px`, top: `${place.bottom + 2}px`, zIndex: 10000,
      padding: "2px 8px", borderRadius: "4px", background: "#c92a2a", color: "#fff", font: "12px system-ui, sans-serif",
    });
    document.body.append(note);
    setTimeout(() => note.remove(), SHOWN_MS);
  }

  // The client reads what changed from the selection before and after: all of the old text, then all of the new one.
  function replace(box, before, text) {
    write.call(box, before);
    box.setSelectionRange(0, before.length);
    box.dispatchEvent(new KeyboardEvent("keydown", { key: "Unidentified", bubbles: true }));
    write.call(box, text);
    box.setSelectionRange(text.length, text.length);
    finished = true;
    box.dispatchEvent(new InputEvent("input", { bubbles: true }));
    finished = false;
  }

  function hold(box, before = box.value) {
    if (held.has(box)) return;
    const entry = { before, typed: false, clients: Object.getOwnPropertyDescriptor(box, "value") };
    held.set(box, entry);
    Object.defineProperties(box, {
      value: { configurable: true, get: () => entry.before, set: (text) => { entry.before = String(text); } },
      setSelectionRange: { configurable: true, value: () => {} },
    });
  }

  function release(box) {
    const { before, clients } = held.get(box);
    held.delete(box);
    delete box.setSelectionRange;
    delete box.value;
    if (clients) Object.defineProperty(box, "value", clients);
    box.value = before;
  }

  function finish(box) {
    if (!held.has(box)) return;
    const { before, typed } = held.get(box), left = textOf.call(box);
    release(box);
    if (!typed) return;
    const text = left.trim().replace("\u2212", "-").replace(",", ".");
    const [low, high] = rangeOf(box);
    const value = Number(text);
    if (text === "" || !Number.isFinite(value)) {
      refuse(box, text === "" ? "a number, such as 12.5" : `${text} is no number`);
    } else if (value < low || value > high) {
      refuse(box, `${text}: out of range (${low} to ${high})`);
    } else {
      replace(box, before, plain(value));
    }
  }

  document.addEventListener("focusin", (event) => {
    if (isNumberBox(event.target)) hold(event.target);
  }, true);
  document.addEventListener("pointerdown", (event) => {
    const box = document.activeElement;
    if (isNumberBox(event.target)) hold(event.target);
    else if (isNumberBox(box) && held.has(box) && !held.get(box).typed) release(box); // a slider leaves the focus there
  }, true);
  document.addEventListener("beforeinput", (event) => {
    if (isNumberBox(event.target) && event.inputType !== "insertLineBreak") hold(event.target); // Enter changes nothing
  }, true);
  document.addEventListener("input", (event) => {
    const box = event.target;
    if (finished || !isNumberBox(box)) return;
    hold(box, box.defaultValue); // unless it is: the client keeps this attribute equal to its value
    held.get(box).typed = true;
    event.stopImmediatePropagation();
  }, true);
  document.addEventListener("change", (event) => {
    // the client reads it as one more "input"
    if (held.get(event.target)?.typed) event.stopImmediatePropagation();
  }, true);
  document.addEventListener("keydown", (event) => {
    const box = event.target;
    if (!isNumberBox(box)) return;
    if (event.key === "Escape" && held.has(box)) release(box);
    else if (["Enter", "ArrowUp", "ArrowDown"].includes(event.key)) finish(box);
    else if (event.isTrusted) hold(box); // again, after Enter: a selection, or the first key of a number
  }, true);
  document.addEventListener("focusout", (event) => {
    // afterwards: the client, too, does something when a box is left, with the value that it knows
    const box = event.target;
    if (isNumberBox(box) && held.has(box)) setTimeout(finish, 0, box);
  }, true);
})();
