"""What a field of a form is about: a sketch of what it measures and what is allowed, shown while it is typed into.

All of them are one widget; the style sheet shows the one whose field has the cursor or lies under the mouse.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from mnclab.lab.forms.groups import groups
from mnclab.lab.sketches import sketch
from mnclab.machine.cycle import Cycle, Parameter, left_out


def about(cycle: type[Cycle], parameters: Sequence[Parameter]) -> str:
    """The cards of all parameters and the rules that show one of them, the first where no field is meant."""
    shown = next(iter(groups(parameters).values()), [])[:1]
    cards = ""
    for k, p in enumerate(parameters):
        cards += f'<div class="mnclab-about mnclab-a{k}{" mnclab-shown" * (p in shown)}">{card(cycle, p)}</div>'
    rules = [".mnclab-form:not(:has(.mnclab-row:is(:focus-within, :hover))) .mnclab-shown"]
    for k in range(len(parameters)):
        rules += [
            f".mnclab-form:has(.mnclab-p{k}:focus-within) .mnclab-a{k}",
            f".mnclab-form:not(:has(.mnclab-row:focus-within)):has(.mnclab-p{k}:hover) .mnclab-a{k}",
        ]
    return f"<style>{', '.join(rules)} {{ display: flex }}</style>{cards}" if parameters else ""


def card(cycle: type[Cycle], p: Parameter) -> str:
    """The sketch of a parameter, its meaning, and what is said of it."""
    otherwise = left_out(p)
    facts = [p.allowed if not p.choices else "", p.note, f"left out: {otherwise}" if otherwise else ""]
    said = "<br>".join(escape(fact) for fact in facts if fact)
    return f"{sketch(cycle, p)}<p><strong>{escape(p.address)}</strong> {escape(p.meaning)}<br>{said}</p>"
