"""What several tests of answers in the page use: one exercise's form, and values of a panel."""

from lively import PATIENCE

REACH = {f"m{i}{j}": 2 for i in (1, 2, 3) for j in (1, 2, 3)} | {"azimuth": 45, "elevation": 35}
"""Values of the panel of exercise 3.2 that answer it."""
FORMULA = (
    "import numpy as np\n\ndef answer(M):\n"
    "    return 2 * np.pi * np.linalg.eigvalsh((M + M.T) / 2)[-1]\n"
)
"""What answers exercise 3.5."""


class Form:
    """One exercise in the page."""

    def __init__(self, page, number):
        self.part = page.locator(f'div.exercise[data-exercise="{number}"]')

    def button(self, name):
        return self.part.get_by_role("button", name=name)

    def expect(self, verdict):
        card = self.part.locator(f'.answer-card[data-verdict="{verdict}"] > [role=status]')
        card.wait_for(timeout=PATIENCE)
        return card.inner_text()

    def line(self, text):
        self.part.get_by_role("textbox").first.fill(text)
        self.part.get_by_role("textbox").first.press("Enter")

    def letters(self, chosen, because=""):
        for box in self.part.get_by_role("checkbox").all():
            box.set_checked(box.get_attribute("value") in chosen)
        self.part.get_by_label("Why?").fill(because)
        self.button("Check").click()

    def python(self, lines):
        area = self.part.locator("textarea")
        if not area.is_visible():
            self.part.get_by_text("Compute it in Python").click()
        area.fill(lines)
        area.press("Shift+Enter")
