"""One notebook open in JupyterLab, and everything that goes wrong in it."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import nbformat

if TYPE_CHECKING:
    from book_server import Server
    from nbformat import NotebookNode
    from playwright.sync_api import BrowserContext, ConsoleMessage, Page, Request


PATIENCE = 180
"""Seconds before a page counts as hung, on a machine that is busy with other things as well."""

FRAME = """new Promise(painted => {
  requestAnimationFrame(painted);
  setTimeout(painted, 500);
})"""
"""The next frame, or half a second: a page behind another may never be painted."""

PATIENCE_WITH_A_CELL = 600
"""The same for one cell; as long as one after the other finishes, a notebook may take any time."""

SCREENS = ("1366x768", "683x384")
"""A common laptop, and the same with everything twice as large."""

FOREIGN = r"^.*No such comm( target registered)?: .*$"
"""What the kernel says when a page asks for widgets before the first cell has imported them."""

LIST_OF_KERNELS = r"/api/kernels\?\d+$"
"""JupyterLab asks for it every few seconds. The server fails while it is just starting a kernel (it
has no time of its last activity yet), and answers the next time."""

LISTEN = """async () => {
  const panel = window.jupyterapp.shell.currentWidget;
  await panel.sessionContext.ready;
  const kernel = panel.sessionContext.session.kernel;
  await kernel.info;  // what is sent while a kernel starts is lost
  window.trouble = [];
  window.started = 0;  // how many cells
  kernel.iopubMessage.connect((_, message) => {
    const { msg_type } = message.header;
    if (msg_type === "execute_input") window.started += 1;
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
}"""

RUN_ALL = """() => {
  window.finished = window.jupyterapp.commands.execute("notebook:run-all-cells");
}"""

# What was open is closed without questions: nobody wants to keep its changes.
REPLACE = """async (path) => {
  const { shell, commands } = window.jupyterapp;
  const before = shell.currentWidget;
  await before.sessionContext.shutdown();
  before.dispose();
  await commands.execute("docmanager:open", { path });
}"""

SAVE = """async () => {
  const { context } = window.jupyterapp.shell.currentWidget;
  await context.save();
  return context.path;
}"""

REWRITE = """code => {
  const [cell] = window.jupyterapp.shell.currentWidget.content.widgets;
  cell.model.sharedModel.setSource(code);
  window.trouble = [];
}"""

FINISHED = (
    "() => Promise.race([window.finished.then(() => true), new Promise(r => setTimeout(r, 1000))])"
)

SHOW_CELL = """async (index) => {
  const notebook = window.jupyterapp.shell.currentWidget.content;
  notebook.activeCellIndex = index;
  await notebook.scrollToItem(index, "start");
}"""

# A screen at a time, each of which is painted before the next.
READ_THROUGH = f"""async () => {{
  const place = window.jupyterapp.shell.currentWidget.content.outerNode;
  for (let top = 0; top < place.scrollHeight; top += place.clientHeight) {{
    place.scrollTop = top;
    await {FRAME};
    await {FRAME};
  }}
}}"""

CELLS_NOT_RUN = """() => window.jupyterapp.shell.currentWidget.content.widgets
  .filter(({ model }) => model.type === "code" && model.executionCount === null)
  .map(({ model }) => model.id)"""

SHUT_DOWN = """async () => {
  await window.jupyterapp?.shell.currentWidget?.sessionContext?.shutdown();
}"""


def answer(page: Page, script: str, argument: Any = None, patience: float = PATIENCE) -> Any:
    """Call a function in a page and wait for what it promises, but not for ever.

    `Page.evaluate` has no end. It does for what answers at once.
    """
    whole = f"async argument => [await ({script})(argument)]"  # a list, for an empty answer is one
    found = page.wait_for_function(whole, arg=argument, timeout=1000 * patience, polling=100)
    return found.json_value()[0]


def wait_until(page: Page, condition: Callable[[], bool], what: str) -> None:
    """Look at a page frame by frame until a condition holds; what it is, is said if it never does.

    What happens in a page comes to Python only while Python asks for something there.
    """
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {PATIENCE} seconds for {what}")
        page.evaluate(FRAME)


@dataclass
class NotebookPage:
    """A notebook in a page of its own.

    Attributes
    ----------
    page : Page
    server : Server
    trouble : list of str
        What went wrong in the page so far: errors in the console, scripts that failed, requests
        to anything but our server.
    """

    page: Page
    server: Server
    trouble: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.set_default_timeout(1000 * PATIENCE)
        self.page.on("console", self._note_console)
        self.page.on("pageerror", lambda error: self.trouble.append(f"script: {error}"))
        self.page.on("request", self._note_request)

    def _note_console(self, message: ConsoleMessage) -> None:
        url = str(message.location.get("url"))
        passing = "status of 500" in message.text and re.search(LIST_OF_KERNELS, url)
        if message.type == "error" and not passing:
            self.trouble.append(f"console: {message.text} ({url})")

    def _note_request(self, request: Request) -> None:
        if not request.url.startswith((self.server.address + "/", "blob:", "data:")):
            self.trouble.append(f"request to the network: {request.url}")

    def open(self, notebook: str) -> None:
        """Open a notebook of the server in JupyterLab, in place of the one that is open there."""
        self.page.bring_to_front()
        path = f"{self.server.folder.name}/{notebook}"
        if self.page.url.startswith(self.server.address):
            answer(self.page, REPLACE, path)
            self.trouble.clear()
        else:
            url = f"{self.server.address}/lab/tree/{path}?token={self.server.token}&reset"
            self.page.goto(url, wait_until="domcontentloaded")
        self.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")
        answer(self.page, LISTEN)

    def saved(self) -> NotebookNode:
        """Save the notebook as a reader does, and read the file."""
        return nbformat.read(self.server.folder.parent / answer(self.page, SAVE), as_version=4)

    def show(self, code: str) -> None:
        """Let a notebook of one cell show the output of some code, with no trouble so far."""
        self.page.evaluate(REWRITE, code)
        self.trouble.clear()
        self.run_all()

    def run_all(self) -> None:
        """Run all cells and wait for the last of them."""
        self.page.evaluate(RUN_ALL)
        latest, end = -1, 0.0
        while not self.page.evaluate(FINISHED):
            started = self.page.evaluate("window.started")
            if started > latest:
                latest, end = started, time.monotonic() + PATIENCE_WITH_A_CELL
            elif time.monotonic() > end:
                raise TimeoutError(f"code cell {started} takes over {PATIENCE_WITH_A_CELL} seconds")

    def show_cell(self, index: int) -> None:
        """Scroll to a cell; JupyterLab keeps only what is near in the page."""
        answer(self.page, SHOW_CELL, index)

    def read_through(self) -> None:
        """Scroll from the first cell to the last, as fast as they are painted."""
        answer(self.page, READ_THROUGH)

    def show_files(self, wanted: bool) -> None:
        """Show or hide the list of files on the left."""
        self.page.evaluate(
            "wanted => { const shell = window.jupyterapp.shell;"
            " wanted ? shell.expandLeft() : shell.collapseLeft(); }",
            wanted,
        )

    def show_on(self, screen: str) -> None:
        """Take the size of a screen; on a narrow one the list of files is hidden."""
        width, height = map(int, screen.split("x"))
        self.page.set_viewport_size({"width": width, "height": height})
        self.show_files(width > 1000)

    def files_are_shown(self) -> bool:
        """Tell whether the list of files is there."""
        return not self.page.evaluate("window.jupyterapp.shell.leftCollapsed")

    def cells_not_run(self) -> list[str]:
        """Identifiers of the code cells that have not been run."""
        return list(self.page.evaluate(CELLS_NOT_RUN))

    def cells(self) -> list[str]:
        """Identifiers of the notebook's cells."""
        return list(
            self.page.evaluate(
                "window.jupyterapp.shell.currentWidget.content.widgets.map(cell => cell.model.id)"
            )
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
        """End the kernel, if there is one, and close the page."""
        answer(self.page, SHUT_DOWN)
        self.page.close()


@contextmanager
def new_page(context: BrowserContext, server: Server) -> Iterator[NotebookPage]:
    """Open a page in which notebooks of the server can be opened, one after the other."""
    page = NotebookPage(context.new_page(), server)
    try:
        yield page
    finally:
        page.close()
