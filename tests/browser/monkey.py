"""A visitor without a plan: seeded random actions on everything that a page offers."""

import random

MODIFIERS = ("Control", "Shift", "Control+Shift", "")
KEYS = (" ", "n", "r", "p", "j", "k", "x", "f", "1", "2", "3", "4", "5", "Escape", "Control+z", "Control+Shift+z")
NUMBERS = ("0", "-5", "1e9", "nan", "", "0.5", "10", "33.3", "999", "abc")
LEFT_ALONE = ("Load settings", "Save Canvas")  # open a file dialog, which waits for a person

_PICK = """([selector, share]) => {
  const found = [...document.querySelectorAll(selector)].filter(e => !e.disabled && e.checkVisibility())
  return found.length ? found[Math.floor(share * found.length)] : null
}"""


class Monkey:
    """Acts on a page.

    Args:
        screen: the page, see ``conftest``.
        seed: of its choices.
    """

    def __init__(self, screen, seed: int) -> None:
        self.screen, self.random = screen, random.Random(seed)
        self.done: list[str] = []

    def act(self) -> None:
        """One action."""
        kinds = (self._press, self._press, self._slide, self._slide, self._type, self._choose, self._key, self._click,
                 self._drag, self._turn)  # fmt: skip
        what = self.random.choice(kinds) if self.random.random() > 0.01 else self._reload
        try:
            self.done.append(what())
        except Exception as error:
            if "not attached to the DOM" not in str(error):
                raise
            self.done.append("gone")  # another visitor's action removed the widget between the choice and the act

    def _one(self, selector: str):
        """One of the visible elements, or None."""
        return self.screen.page.evaluate_handle(_PICK, [selector, self.random.random()]).as_element()

    def _press(self) -> str:
        element = self._one("button:not([role=tab]), input[type=checkbox]")
        text = element.inner_text().strip() if element else ""
        if element is None or text in LEFT_ALONE:
            return "nothing"
        element.dispatch_event("click")
        return f"press {text!r}"

    def _turn(self) -> str:
        element = self._one("[role=tab]")
        if element is None:
            return "nothing"
        element.dispatch_event("click")
        return f"tab {element.inner_text()!r}"

    def _slide(self) -> str:
        element = self._one("[role=slider]")
        if element is None:
            return "nothing"
        element.focus()
        key = self.random.choice(("ArrowLeft", "ArrowRight", "Home", "End", "PageUp"))
        for _ in range(self.random.randint(1, 5)):
            self.screen.page.keyboard.press(key)
        return f"slide {key}"

    def _type(self) -> str:
        element = self._one("input[type=text]:not([readonly])")
        if element is None:
            return "nothing"
        text = self.random.choice(NUMBERS)
        element.focus()
        element.fill(text, force=True)
        self.screen.page.keyboard.press(self.random.choice(("Enter", "Tab")))
        return f"type {text!r}"

    def _choose(self) -> str:
        element = self._one("input[aria-haspopup=listbox]")
        if element is None:
            return "nothing"
        element.dispatch_event("click")
        option = self._one("[role=option]")
        if option is None:
            return "opened"
        text = option.inner_text()
        option.dispatch_event("click")
        return f"choose {text!r}"

    def _key(self) -> str:
        page, key = self.screen.page, self.random.choice(KEYS)
        page.evaluate("() => document.activeElement && document.activeElement.blur()")
        page.keyboard.press(key)
        return f"key {key!r}"

    def _somewhere(self) -> tuple[float, float]:
        box = self.screen.canvas_box()
        return (box["x"] + box["width"] * self.random.uniform(0.05, 0.95),
                box["y"] + box["height"] * self.random.uniform(0.05, 0.95))  # fmt: skip

    def _click(self) -> str:
        modifier = self.random.choice(MODIFIERS)
        self._with(modifier, lambda: self.screen.page.mouse.click(*self._somewhere()))
        return f"click {modifier}"

    def _drag(self) -> str:
        mouse, modifier = self.screen.page.mouse, self.random.choice(MODIFIERS)

        def drag() -> None:
            mouse.move(*self._somewhere())
            mouse.down()
            for _ in range(self.random.randint(1, 4)):
                mouse.move(*self._somewhere())
            mouse.up()

        self._with(modifier, drag)
        return f"drag {modifier}"

    def _with(self, modifier: str, act) -> None:
        keyboard, keys = self.screen.page.keyboard, [key for key in modifier.split("+") if key]
        for key in keys:
            keyboard.down(key)
        act()
        for key in reversed(keys):
            keyboard.up(key)

    def _reload(self) -> str:
        self.screen.open()
        return "reload"
