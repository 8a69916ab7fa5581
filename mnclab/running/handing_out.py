"""Handing the words of a block out: each function and cycle takes its own, and what is left is an alarm.

A plan depends on the keyword, the addresses, the G and M words of a block, and on the few things in `Modal`; the
interpreter makes it once for each kind of block, and an explanation makes it again from the history. No word is lost by
construction: every one is in a plan or in an alarm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from operator import itemgetter
from typing import NamedTuple

from mnclab.machine.control import Control, Function, Modal, Remark
from mnclab.machine.cycle import Cycle
from mnclab.text.alarm import Alarm
from mnclab.text.nearest import hint
from mnclab.text.program import Word, digits


class Action(NamedTuple):
    """One part of a plan: a function or a cycle, the word that called it (or -1), and the words it takes."""

    phase: int
    what: Function | type[Cycle]
    code: str
    head: int
    takes: tuple[int, ...]

    @property
    def pick(self) -> Callable[[list[Word]], tuple[Word, ...]]:
        """Takes its words out of a block: for a function the one that called it is the first."""
        which = (self.head, *self.takes) if self.head >= 0 and isinstance(self.what, Function) else self.takes
        return itemgetter(*which) if len(which) > 1 else lambda words: tuple([words[k] for k in which])


class Plan(NamedTuple):
    """What to do with a kind of block, in order, and remarks about it."""

    actions: tuple[tuple[Action, Callable[[list[Word]], tuple[Word, ...]]], ...]
    remarks: tuple[Remark, ...]


class Planner:
    """Hands the words of one block out; `strange` is what the control remarks about them, also where that is an alarm."""

    def __init__(self, control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
        self.control, self.modal, self.keyword, self.words, self.active = control, modal, keyword, words, modal.active
        self.phases = {name: k for k, name in enumerate(control.phases)}
        self.owner: list[str] = [""] * len(words)  # who takes a word
        self.actions: list[Action] = []
        self.strange: list[Remark] = []
        self.remarks: list[Remark] = []

    def alarm(self, message: str, index: int, hint: str = "") -> None:
        raise Alarm(message, self.words[index].span if index >= 0 else None, hint=hint)

    def plan(self) -> Plan:
        if self.control.together:
            self.strange = [*(self.control.together(self.control, self.modal, self.keyword, self.words) or ())]
        codes = self.codes()
        cycle = next(((c, i) for c, i in codes if c in self.control.cycles), None)
        if cycle:
            self.claim(self.control.cycles[cycle[0]], cycle[0], cycle[1])
            codes = [(c, i) for c, i in codes if i < 0 or self.owner[i] == ""]
            codes = [(c, i) for c, i in codes if i != cycle[1]]
            for code, index in codes:
                other = self.control.functions.get(code)
                if code == cycle[0]:
                    self.alarm(f"{code} is written twice in this block", index, "keep one of them")
                if code in self.control.cycles or (other and other.ends_cycle):
                    self.alarm(f"{code} and {cycle[0]} are of one group: only one of it may stand in a block", index)
        functions = [(self.function(code, index), index) for code, index in codes]
        self.check_groups([f for f, _ in functions], [i for _, i in functions])
        for function, index in functions:
            if index >= 0:
                self.owner[index] = function.code
        for function, index in functions:
            if not function.moves:
                self.hand_out(function, index)
        ending = any(f.ends_cycle for f, _ in functions)
        if self.active and not cycle and not ending:
            self.claim_again([f for f, _ in functions if f.moves])
        owned = any(f.owns for f, _ in functions)
        for function, index in functions:
            if function.moves and (function.owns or not owned):
                self.hand_out(function, index)
            elif function.moves:  # it only becomes active
                self.actions.append(Action(self.phases[function.phase], function, function.code, index, ()))
        self.refuse_motion([f for f, _ in functions])
        at_once = cycle is not None and self.control.cycles[cycle[0]].runs == "definition"
        if at_once and cycle and not self.control.one_command:
            self.refuse_beside(cycle[0])
        self.word_functions()
        if self.control.one_command and self.actions:
            self.refuse_strangers(self.actions[0])
        prepared = cycle is not None and self.control.cycles[cycle[0]].runs == "call"
        if not (
            prepared or at_once
        ):  # preparing a cycle moves nothing; one that runs at once makes all moves of its block
            self.modal_motion([f for f, _ in functions])
        self.modal_call([f for f, _ in functions])
        self.refuse_leftovers([f for f, _ in functions])
        self.refuse_repeated()
        order = sorted(self.actions, key=lambda action: action.phase)
        return Plan(tuple((action, action.pick) for action in order), (*self.strange, *self.remarks))

    def codes(self) -> list[tuple[str, int]]:
        found = [(self.keyword, -1)] if self.keyword else []
        for i, word in enumerate(self.words):
            if word.address in self.control.codes and type(word.value) is float:
                found.append((f"{word.address}{digits(word.value)}", i))
        return found

    def function(self, code: str, index: int) -> Function:
        found = self.control.functions.get(code)
        every = self.control.functions.get(code[0])  # one function for all codes of an address that have none of their own
        if found is None and every is not None and code[1:].isdigit() and index >= 0:
            return replace(every, code=code)
        if found is None:
            if code in self.control.refused:
                self.alarm(f"{code} is refused: {self.control.refused[code]}", index)
            meant = code.replace("-", "").partition(".")[0]
            near = hint(meant, (*self.control.functions, *self.control.cycles))
            self.alarm(f"{code} is not a function of this control", index, near)
        assert found is not None
        return found

    def check_groups(self, functions: list[Function], indices: list[int]) -> None:
        seen: dict[str, str] = {}  # group, or the code itself where it has none
        for function, index in zip(functions, indices, strict=True):
            group = function.group or function.code
            if seen.get(group) == function.code:
                self.alarm(f"{function.code} is written twice in this block", index, "keep one of them")
            if group in seen:
                one_of = "only one function of a group may stand in a block"
                self.alarm(f"{function.code} and {seen[group]} are of one group: {one_of}", index)
            seen[group] = function.code

    def claim(self, cycle: type[Cycle], code: str, index: int) -> None:
        """A cycle takes its addresses before any function sees them."""
        room: dict[str, int] = {}
        for parameter in cycle.parameters():
            for address in (parameter.address, *parameter.aliases):
                room[address] = room.get(address, 0) + (len(self.words) if parameter.several else 1)
        taken = []
        for i, word in enumerate(self.words):
            if i != index and not self.owner[i] and room.get(word.address, 0):
                room[word.address] -= 1
                self.owner[i] = code
                taken.append(i)
        if index >= 0:
            self.owner[index] = code
        self.actions.append(Action(self.phases["motion"], cycle, code, index, tuple(taken)))

    def claim_again(self, moving: list[Function]) -> None:
        """An active cycle runs again where one of its trigger addresses stands."""
        assert self.active is not None
        if any(
            not owner and word.address in self.active.triggers
            for word, owner in zip(self.words, self.owner, strict=True)
        ):
            self.claim(self.active, self.active.code, -1)
            action = self.actions.pop()
            self.actions.append(action._replace(head=-1))
            for function in moving:
                index = next(i for i, owner in enumerate(self.owner) if owner == function.code)
                sentence = f"{function.code} is kept for later: {self.active.code} is active and runs at this position"
                self.remarks.append((index, sentence, "write G80 first to end the cycle"))

    def hand_out(self, function: Function, index: int) -> None:
        taken = []
        for address in function.takes:
            several, address = address.endswith("*"), address.rstrip("*")
            for i, word in enumerate(self.words):
                if word.address != address or i == index:
                    continue
                if self.owner[i] and self.owner[i] != function.code:
                    if function.moves and self.owner[i] in self.control.cycles:
                        break  # a second one is a repeated address, no motion
                    claimed = function.still and self.owner[i] in self.control.cycles
                    if claimed or (self.owner[i] in self.control.functions and word.address not in self.control.codes):
                        self.alarm(
                            f"{self.owner[i]} and {function.code} both take {word}", i, "write them in two blocks"
                        )
                    continue
                if not self.owner[i]:
                    self.owner[i] = function.code
                    taken.append(i)
                    if not several:
                        break
        self.actions.append(Action(self.phases[function.phase], function, function.code, index, tuple(taken)))

    def word_functions(self) -> None:
        """F, S, T and the like: addresses that are functions by themselves."""
        if not self.control.word_functions:
            return
        for i, word in enumerate(self.words):
            if not self.owner[i] and word.address not in self.control.codes and word.address in self.control.functions:
                function = self.control.functions[word.address]
                if any(w.address == word.address and self.owner[k] for k, w in enumerate(self.words)):
                    continue  # a second one, of a cycle too, is a repeated address
                self.owner[i] = function.code
                self.hand_out(function, i)

    def refuse_strangers(self, command: Action) -> None:
        """Where a block is one command: words that it does not take."""
        own = {command.head, *command.takes}
        for i, word in enumerate(self.words):
            if i in own:
                continue
            alike = sum(self.words[k].address == word.address for k in own)
            if alike:
                times = "once" if alike == 1 else f"{alike} times"
                self.alarm(f"{command.code} takes {word.address} {times}: {word} is one too many", i)
            what = command.what
            takes = what.takes if isinstance(what, Function) else [p.address for p in what.parameters() if not p.mark]
            whose = f", which takes {' '.join(takes).replace('*', '')}" if takes else ""
            self.alarm(f"{word} does not belong to the command {command.code}{whose}", i)

    def modal_motion(self, functions: list[Function]) -> None:
        """Axis words that are left belong to the modal motion."""
        code = self.modal.motion
        function = self.control.functions.get(code) if code else None
        if function is None or self.keyword or any(f.still or f.moves for f in functions):
            return
        if any(
            not owner and word.address in function.takes for word, owner in zip(self.words, self.owner, strict=True)
        ):
            self.hand_out(function, -1)

    def modal_call(self, functions: list[Function]) -> None:
        """A modal call of a cycle runs it in every block that positions and has no call of its own."""
        again = self.control.calls_again
        modal = self.control.functions.get(self.modal.call or "")
        own = next((f for f in functions if f.group == "call"), None)
        if again is None or not (modal or (own and own.modal)):
            return
        if again(self.keyword, self.words) and modal and own is None:
            self.hand_out(modal, -1)

    def refuse_motion(self, functions: list[Function]) -> None:
        """A function that moves nothing beside one that moves: words of the motion."""
        still = next((f.code for f in functions if f.still), None)
        moved = next(
            (a.takes[0] for a in self.actions if a.takes and isinstance(a.what, Function) and a.what.moves), -1
        )
        if still and moved >= 0:
            word = self.words[moved]
            self.alarm(
                f"{still} stands in a block without motion, {word} does not belong to it", moved, "write two blocks"
            )

    def refuse_beside(self, code: str) -> None:
        """Another motion, or the call of a cycle, in the block of one that runs at once."""
        for action in self.actions:
            if isinstance(action.what, Function) and (
                action.what.phase == "call" or action.what.moves and action.takes
            ):
                index = action.takes[0] if action.takes else action.head
                sentence = f"{code} runs in a block of its own, {self.words[index]} does not belong to it"
                self.alarm(sentence, index, "write two blocks")

    def refuse_leftovers(self, functions: list[Function]) -> None:
        still = next((f.code for f in functions if f.still), None)
        for i, word in enumerate(self.words):
            if self.owner[i] or any(w.address == word.address and self.owner[k] for k, w in enumerate(self.words)):
                continue
            code = f"{word.address}{digits(word.value)}" if type(word.value) is float else ""
            if code in self.control.refused:
                self.alarm(self.control.refused[code], i)
            if word.address in self.control.refused:
                self.alarm(f"{word.address} is refused: {self.control.refused[word.address]}", i)
            if still and word.address in self.control.axes:
                self.alarm(
                    f"{still} stands in a block without motion, {word} does not belong to it", i, "write two blocks"
                )
            actors = " ".join(dict.fromkeys(a.code for a in self.actions if a.phase == self.phases["motion"]))
            self.alarm(
                f"{word} has no meaning in this block"
                + (f" ({actors} does not take {word.address})" if actors else ""),
                i,
            )

    def refuse_repeated(self) -> None:
        for i, word in enumerate(self.words):
            if not self.owner[i]:
                self.alarm(f"{word.address} is written twice in this block", i, "keep one of them")
