"""One notebook open in JupyterLab, and everything that goes wrong in it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import ConsoleMessage, Page, Request


PATIENCE = 60_000
"""Milliseconds before a page counts as hung."""

FOREIGN = r"^.*No such comm( target registered)?: .*$"
"""What the kernel says when a page asks for widgets before the first cell has imported them."""

RUN_ALL = """async () => {
  const panel = window.jupyterapp.shell.currentWidget;
  await panel.sessionContext.ready;
  const kernel = panel.sessionContext.session.kernel;
  await kernel.info;  // what is sent while a kernel starts is lost
  window.trouble = [];
  kernel.iopubMessage.connect((_, message) => {
    const { msg_type } = message.header;
    if (msg_type === "error") window.trouble.push(message.content.traceback.join("\\n"));
    if (msg_type === "stream" && message.content.name === "stderr") {
      window.trouble.push(message.content.text);
    }
  });
  window.unanswered = new Set();  // messages of widgets that the kernel is still busy with
  kernel.anyMessage.connect((_, { msg, direction }) => {
    const { msg_type, msg_id } = msg.header;
    if (direction === "send" && msg_type === "comm_msg") window.unanswered.add(msg_id);
    if (msg_type === "status" && msg.content.execution_state === "idle") {
      window.unanswered.delete(msg.parent_header.msg_id);
    }
  });
  window.finished = window.jupyterapp.commands.execute("notebook:run-all-cells");
}"""

FINISHED = (
    "() => Promise.race([window.finished.then(() => true), new Promise(r => setTimeout(r, 1000))])"
)

SHOW_CELL = """async (index) => {
  const notebook = window.jupyterapp.shell.currentWidget.content;
  notebook.activeCellIndex = index;
  await notebook.scrollToItem(index, "start");
}"""

SHUT_DOWN = """async () => {
  const panel = window.jupyterapp.shell.currentWidget;
  await window.jupyterapp.commands.execute("docmanager:save");
  await panel.sessionContext.shutdown();
}"""


@dataclass
class NotebookPage:
    """A notebook in a page of its own.

    Attributes
    ----------
    page : Page
    address, token : str
        Of the server.
    trouble : list of str
        What went wrong in the page so far: errors in the console, scripts that failed, requests
        to anything but our server.
    """

    page: Page
    address: str
    token: str
    trouble: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", self._note_console)
        self.page.on("pageerror", lambda error: self.trouble.append(f"script: {error}"))
        self.page.on("request", self._note_request)

    def _note_console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.trouble.append(f"console: {message.text} ({message.location.get('url')})")

    def _note_request(self, request: Request) -> None:
        if not request.url.startswith((self.address + "/", "blob:", "data:")):
            self.trouble.append(f"request to the network: {request.url}")

    def open(self, notebook: str) -> None:
        """Open a notebook of the server in JupyterLab."""
        query = f"token={self.token}&reset"
        self.page.goto(f"{self.address}/lab/tree/{notebook}?{query}", wait_until="domcontentloaded")
        self.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")

    def run_all(self) -> None:
        """Run all cells and wait for the last of them."""
        self.page.evaluate(RUN_ALL)
        for _ in range(300):
            if self.page.evaluate(FINISHED):
                return
        raise TimeoutError("the cells did not finish within five minutes")

    def show_cell(self, index: int) -> None:
        """Scroll to a cell; JupyterLab keeps only what is near in the page."""
        self.page.evaluate(SHOW_CELL, index)

    def show_files(self, wanted: bool) -> None:
        """Show or hide the list of files on the left."""
        self.page.evaluate(
            "wanted => { const shell = window.jupyterapp.shell;"
            " wanted ? shell.expandLeft() : shell.collapseLeft(); }",
            wanted,
        )

    def files_are_shown(self) -> bool:
        """Tell whether the list of files is there."""
        return not self.page.evaluate("window.jupyterapp.shell.leftCollapsed")

    def count_cells(self) -> int:
        """Number of cells of the notebook."""
        return int(
            self.page.evaluate("window.jupyterapp.shell.currentWidget.content.widgets.length")
        )

    def all_trouble(self) -> list[str]:
        """Everything that went wrong: in the page, in the kernel, in outputs and in panels."""
        from_kernel = [
            text
            for text in self.page.evaluate("window.trouble || []")
            if re.sub(FOREIGN, "", text, flags=re.MULTILINE).strip()
        ]
        tracebacks = self.page.evaluate(
            "[...document.querySelectorAll('.driftlab-error')].map(e => e.textContent)"
        )
        text = self.page.locator("body").inner_text()
        seen = re.findall(r".*Traceback \(most recent call last\).*", text)
        return [*self.trouble, *from_kernel, *tracebacks, *seen]

    def close(self) -> None:
        """End the kernel and close the page."""
        self.page.evaluate(SHUT_DOWN)
        self.page.close()
