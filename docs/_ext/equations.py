"""Directives of the pages about the model: an equation with the code that carries it out, and the code as a page.

`equation` has the paper's numbers, as `6, 8, 11`, and the formula as its body; `equation-table` lists every equation with
links to its formula and its lines; `kernel-source` shows the files of the kernel, each line with an anchor.
"""

import re
from typing import Any

from docutils import nodes
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from tags import FILES, Place, numbers, places, source

MODEL, CODE = "model.html", "architecture.html"


def anchor(place: Place) -> str:
    """The address of a line of the kernel."""
    return f"{CODE}#{place.file}-{place.line}"


def link(place: Place) -> nodes.reference:
    """A link to a line of the kernel."""
    text = f"kernel/{place.file}.py, line {place.line}"
    return nodes.reference("", text, refuri=anchor(place), internal=True)


def shown(place: Place) -> list[nodes.Node]:
    """The link to a place and its lines."""
    code = nodes.literal_block(place.text, place.text, language="python", classes=["equation-code"])
    return [nodes.paragraph("", "", link(place), classes=["equation-place"]), code]


class Equation(SphinxDirective):
    """Formula, numbers and code of one equation or several that belong together."""

    required_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        """The formula beside its numbers, above the code."""
        found: list[Place] = []
        wanted = numbers(self.arguments[0])
        for number in wanted:
            if number not in places():
                raise self.error(f"no line of the kernel is tagged Eq. {number}")
            found += [place for place in places()[number] if place not in found]
        box = nodes.container(classes=["equation"], ids=[f"eq-{number}" for number in wanted])
        row = nodes.container(classes=["equation-row"])
        formula = "\n".join(self.content)
        row += nodes.math_block(formula, formula, nowrap=False, number=None, label=None, docname=self.env.docname)
        row += nodes.inline("", f"({self.arguments[0]})", classes=["equation-number"])
        box += row
        # Places within another excerpt of this equation are shown there.
        for place in found:
            if not any(o != place and o.file == place.file and o.line <= place.line and place.end <= o.end for o in found):
                box += shown(place)
        return [box]


class EquationTable(SphinxDirective):
    """Every equation with links to its formula and to its lines."""

    def run(self) -> list[nodes.Node]:
        """The table."""
        table, group = nodes.table(classes=["equation-table"]), nodes.tgroup(cols=2)
        group += [nodes.colspec(colwidth=1), nodes.colspec(colwidth=9)]
        head, body = nodes.thead(), nodes.tbody()
        head += row([nodes.Text("Eq.")], [nodes.Text("lines that name it")])
        for number, found in sorted(places().items()):
            to_formula = nodes.reference("", str(number), refuri=f"{MODEL}#eq-{number}", internal=True)
            links: list[nodes.Node] = []
            for place in found:
                links += [nodes.Text("; "), link(place)]
            body += row([to_formula], links[1:])
        group += [head, body]
        table += group
        return [table]


def row(*cells: list[nodes.Node]) -> nodes.row:
    """A row of a table."""
    return nodes.row("", *(nodes.entry("", nodes.paragraph("", "", *cell)) for cell in cells))


class KernelSource(SphinxDirective):
    """The kernel's files with numbered lines; tags link back to the formulas."""

    def run(self) -> list[nodes.Node]:
        """A section per file."""
        sections: list[nodes.Node] = []
        for file in FILES:
            name = f"kernel/{file}.py"
            section = nodes.section("", nodes.title(name, name), ids=[file], names=[name])
            section += nodes.raw("", listing(file), format="html")
            sections.append(section)
        return sections


def listing(file: str) -> str:
    """A file as HTML with an anchor per line."""
    formatter = HtmlFormatter(linenos="inline", lineanchors=file, anchorlinenos=True, cssclass="highlight")
    html = highlight("\n".join(source(file)) + "\n", PythonLexer(), formatter)
    return re.sub(r"Eq\. (\d+)", rf'<a class="equation-tag" href="{MODEL}#eq-\1">Eq. \1</a>', html)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives; their pages change with the kernel."""
    app.add_directive("equation", Equation)
    app.add_directive("equation-table", EquationTable)
    app.add_directive("kernel-source", KernelSource)
    app.connect("env-get-outdated", lambda *_: ["model", "architecture"])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
