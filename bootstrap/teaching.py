"""Commands for whoever teaches from the book: slides and paper, made by the site's tools."""

from bootstrap.beside import SITE_LIST, beside
from bootstrap.environment import set_up
from bootstrap.steps import running


def slides(arguments: list[str]) -> int:
    """Make the slides of some chapters, or of all."""
    return by_site_tools("site/slides/make.py", arguments)


def by_site_tools(script: str, arguments: list[str]) -> int:
    """Run a script of the site in the environment that has its tools and return its exit code."""
    set_up()
    python = beside(SITE_LIST)
    with running([str(python), script, *arguments]) as process:
        return abs(process.wait())
