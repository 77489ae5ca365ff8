// Number boxes of the page: what is typed is sent when it is finished, with Enter or by leaving the box. A comma is a
// decimal point. What is no number, or out of the slider's range, is said beside the box, and the old value stays.
//
// The client would take every key for a value (on the way to 120 also 1 and 12), and would put what is out of range
// to the nearest end of it. So the "input" events of number boxes are held back from it, in the capture phase, until
// the text is finished; then one of them is let through. Meanwhile the client goes on to write the value of a box that
// follows the run: what it wrote is remembered, and the typed text put back.
(() => {
  const SHOWN_MS = 4000;
  const begun = new Map(); // box in which somebody types -> what the client shows there, and the text typed so far
  const shown = new WeakMap(); // box -> its text before the key that may come to change it
  let finished = false;

  const isNumberBox = (target) =>
    target instanceof HTMLInputElement && target.classList.contains("mantine-NumberInput-input");

  // past the copy of the text that the client's library keeps on the element: it must see that the text is new
  const write = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set;

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

  function begin(box, before) {
    if (begun.has(box)) return;
    begun.set(box, { before, typed: before });
    if (begun.size === 1) requestAnimationFrame(keepTyped);
  }

  // What the client wrote over the typed text is its newest value.
  function follow(box) {
    const entry = begun.get(box);
    if (box.value !== entry.typed) entry.before = box.value;
    return entry;
  }

  function keepTyped() {
    for (const box of begun.keys()) {
      const { typed } = follow(box);
      if (!box.isConnected) begun.delete(box);
      else if (box.value !== typed) {
        write.call(box, typed);
        box.setSelectionRange(typed.length, typed.length);
      }
    }
    if (begun.size) requestAnimationFrame(keepTyped);
  }

  function finish(box) {
    if (!begun.has(box)) return;
    const { before, typed } = follow(box);
    begun.delete(box);
    const text = typed.trim().replace("\u2212", "-").replace(",", ".");
    const [low, high] = rangeOf(box);
    const value = Number(text);
    if (text === "" || !Number.isFinite(value)) {
      write.call(box, before);
      refuse(box, text === "" ? "a number, such as 12.5" : `${text} is no number`);
    } else if (value < low || value > high) {
      write.call(box, before);
      refuse(box, `${text}: out of range (${low} to ${high})`);
    } else {
      replace(box, before, text);
    }
  }

  document.addEventListener("beforeinput", (event) => {
    // no beginning yet: Enter, and Backspace in an empty box, announce a change that never comes
    const box = event.target;
    if (!isNumberBox(box)) return;
    shown.set(box, box.value);
    setTimeout(() => shown.delete(box), 0);
  }, true);
  document.addEventListener("input", (event) => {
    if (finished || !isNumberBox(event.target)) return;
    begin(event.target, shown.get(event.target) ?? event.target.defaultValue);
    begun.get(event.target).typed = event.target.value;
    event.stopImmediatePropagation();
  }, true);
  document.addEventListener("change", (event) => {
    if (begun.has(event.target)) event.stopImmediatePropagation(); // the client reads it as one more "input"
  }, true);
  document.addEventListener("keydown", (event) => {
    if (!isNumberBox(event.target)) return;
    if (event.key === "Escape" && begun.has(event.target)) {
      write.call(event.target, follow(event.target).before);
      begun.delete(event.target);
    } else if (["Enter", "ArrowUp", "ArrowDown"].includes(event.key)) {
      finish(event.target);
    }
  }, true);
  document.addEventListener("focusout", (event) => {
    // afterwards: the client, too, does something when a box is left, with the value that it knows
    const box = event.target;
    if (isNumberBox(box) && begun.has(box)) setTimeout(finish, 0, box);
  }, true);
})();
