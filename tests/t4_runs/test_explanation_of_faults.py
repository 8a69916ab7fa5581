"""A page or an alarm about every line of a program with faults: refused statements, and samples changed at random."""

import random
from pathlib import Path

import pytest
from tools.together import together

import mnclab
from mnclab import Alarm

SAMPLES = sorted((Path(__file__).parent.parent.parent / "data" / "programs").rglob("*.*"))
CHARACTERS = "0123456789.-+XYZGMQL ;,*~@#/=\"()IFR"


def look_at(run):
    """Everything that tells people about a run."""
    repr(run), run._repr_html_(), run.summary(), repr(run.program), run.program._repr_html_()
    for alarm in run.alarms:
        str(alarm), alarm._repr_html_(), alarm.as_dict(), alarm._render_traceback_()
    run.when("z < -1")
    executed = set(run.lines().tolist())
    for line in range(1, len(run.program.line_starts) + 1):
        for tell in (run.at, run.explain):
            try:
                page = tell(line=line)
            except Alarm as alarm:
                assert line not in executed and "holds no block" in str(alarm)
            else:
                assert str(page)
    if executed and not run.ok:
        run.explain(step=len(run.steps.block) - 1)._repr_html_()


def mutated(text, chance):
    """A text with one to four changes: lines lost or doubled, characters and words lost, added or exchanged."""
    lines = text.splitlines()
    for _ in range(chance.randint(1, 4)):
        k, what = chance.randrange(len(lines)), chance.random()
        line = lines[k]
        at = chance.randrange(len(line) + 1)
        if what < 0.2 and len(lines) > 2:
            del lines[k]
        elif what < 0.3:
            lines.insert(k, chance.choice(lines))
        elif what < 0.5:
            lines[k] = line[:at] + line[at + 1 :]
        elif what < 0.7:
            lines[k] = line[:at] + chance.choice(CHARACTERS) + line[at + 1 :]
        else:
            words = line.split(" ")
            words[chance.randrange(len(words))] = chance.choice(["", chance.choice(chance.choice(lines).split(" "))])
            lines[k] = " ".join(words)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("control", mnclab.controls)
def test_samples_changed_at_random(control):
    chance = random.Random(13)
    short = [file for file in SAMPLES if file.parent.name == control and file.stat().st_size < 2000]
    told = 0
    while told < 25:
        run = mnclab.run(mutated(chance.choice(short).read_text("utf-8"), chance), control)
        if not run.ok:
            told += 1
            look_at(run)


@together("code", mnclab.controls["tnc-620"].refused, lambda code: code.split()[0])
def test_refused_statements_of_the_tnc(code):
    run = mnclab.run(f"L X+1 FMAX\n{code}\nL X+2 FMAX\n", "tnc-620")
    assert not run.ok
    look_at(run)


@pytest.mark.parametrize("line", [2, 3])
def test_a_fault_in_a_later_line_of_a_block_is_that_of_the_block(line):
    lines = ["CYCL DEF 200 ~", "Q200=2 ~", "Q201=-5"]
    lines[line - 1] = lines[line - 1].replace("=", "=)")
    run = mnclab.run("\n".join(lines) + "\n", "tnc-620")
    assert [alarm.span.line for alarm in run.alarms] == [line]
    assert all("refused" in meaning.says for meaning in run.explain(line=1).meanings)
    look_at(run)
