"""Handing the words of a block out: each function and cycle takes its own, and what is left is an alarm.

A plan depends on the keyword, the addresses, the G and M words of a block, and on the few things in `Modal`; the
interpreter makes it once for each kind of block, and an explanation makes it again from the history. No word is lost by
construction: every one is in a plan or in an alarm.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from operator import itemgetter
from typing import NamedTuple, NoReturn

from mnclab.machine.control import Control, Function, Modal, Remark
from mnclab.machine.cycle import Cycle
from mnclab.text.alarm import Alarm, hint
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


class BlockPlan(NamedTuple):
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

    def alarm(self, message: str, index: int, hint: str = "") -> NoReturn:
        raise Alarm(message, self.words[index].span if index >= 0 else None, hint=hint)

    def plan(self) -> BlockPlan:
        control = self.control
        if control.together:
            self.strange = [*(control.together(control, self.modal, self.keyword, self.words) or ())]
        codes = self.codes()
        name, at = next(((c, i) for c, i in codes if c in control.cycles), ("", -1))
        cycle = control.cycles.get(name)
        if cycle:
            self.claim(cycle, name, at)
            codes = [(c, i) for c, i in codes if i != at and (i < 0 or self.owner[i] == "")]
            for code, index in codes:
                other = control.functions.get(code)
                if code == name:
                    self.alarm(f"{code} is written twice in this block", index, "keep one of them")
                if code in control.cycles or (other and other.ends_cycle):
                    self.alarm(f"{code} and {name} are of one group: only one of it may stand in a block", index)
        called = [(self.function(code, index), index) for code, index in codes]
        functions = [function for function, _ in called]
        self.check_groups(called)
        for function, index in called:
            if index >= 0:
                self.owner[index] = function.code
        for function, index in called:
            if not function.moves:
                self.hand_out(function, index)
        if self.active and not cycle and not any(f.ends_cycle for f in functions):
            if self.modal.ends and any(f.moves for f in functions):
                over = next(f for f in control.functions.values() if f.ends_cycle)
                self.act(over, over.code, -1, ())
            else:
                self.claim_again(functions)
        owned = any(f.owns for f in functions)
        for function, index in called:
            if function.moves and (function.owns or not owned):
                self.hand_out(function, index)
            elif function.moves:  # it only becomes active
                self.act(function, function.code, index, ())
        self.refuse_motion(functions)
        runs = cycle.runs if cycle else ""
        if runs == "definition" and not control.one_command:
            self.refuse_beside(name)
        self.word_functions()
        if control.one_command and self.actions:
            self.refuse_strangers(self.actions[0])
        if runs not in ("definition", "call"):  # which make all moves of their block, or none
            self.modal_motion(functions)
        self.modal_call(functions)
        self.refuse_leftovers(functions)
        order = sorted(self.actions, key=lambda action: action.phase)
        return BlockPlan(tuple((action, action.pick) for action in order), (*self.strange, *self.remarks))

    def codes(self) -> list[tuple[str, int]]:
        found = [(self.keyword, -1)] if self.keyword else []
        for i, word in enumerate(self.words):
            if word.address in self.control.codes and type(word.value) is float:
                found.append((f"{word.address}{digits(word.value)}", i))
        return found

    def function(self, code: str, index: int) -> Function:
        control = self.control
        if code in control.functions:
            return control.functions[code]
        if code in control.refused:
            self.alarm(f"{code} is refused: {control.refused[code]}", index)
        every = control.functions.get(code[0])  # one for all codes of an address that have none of their own
        if every is not None and code[1:].isdigit() and index >= 0:
            return replace(every, code=code)
        near = hint(code.replace("-", "").partition(".")[0], (*control.listed, *control.cycles))
        self.alarm(f"{code} is not a function of this control", index, near)

    def check_groups(self, called: list[tuple[Function, int]]) -> None:
        seen: dict[str, str] = {}  # group, or the code itself where it has none
        for function, index in called:
            group = function.group or function.code
            if seen.get(group) == function.code:
                self.alarm(f"{function.code} is written twice in this block", index, "keep one of them")
            if group in seen:
                one_of = "only one function of a group may stand in a block"
                self.alarm(f"{function.code} and {seen[group]} are of one group: {one_of}", index)
            seen[group] = function.code

    def act(self, what: Function | type[Cycle], code: str, head: int, takes: Iterable[int]) -> None:
        phase = what.phase if isinstance(what, Function) else "motion"
        self.actions.append(Action(self.phases[phase], what, code, head, tuple(takes)))

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
        self.act(cycle, code, index, taken)

    def claim_again(self, functions: list[Function]) -> None:
        """An active cycle runs again where one of its trigger addresses stands."""
        assert self.active is not None
        if not self.left_of(self.active.triggers):
            return
        self.claim(self.active, self.active.code, -1)
        for function in functions:
            if function.moves:
                sentence = f"{function.code} is kept for later: {self.active.code} is active and runs at this position"
                self.remarks.append((self.owner.index(function.code), sentence, "write G80 first to end the cycle"))

    def hand_out(self, function: Function, index: int) -> None:
        control, taken = self.control, []
        for address in function.takes:
            several, address = address.endswith("*"), address.rstrip("*")
            for i, word in enumerate(self.words):
                if word.address != address or i == index:
                    continue
                owner = self.owner[i]
                if owner and owner != function.code:
                    if function.moves and owner in control.cycles:
                        break  # a second one is a repeated address, no motion
                    claimed = function.still and owner in control.cycles
                    if claimed or (owner in control.functions and word.address not in control.codes):
                        self.alarm(f"{owner} and {function.code} both take {word.rounded}", i, "write them in two blocks")
                elif not owner:
                    self.owner[i] = function.code
                    taken.append(i)
                    if not several:
                        break
        self.act(function, function.code, index, taken)

    def left_of(self, addresses: Collection[str]) -> bool:
        """Whether a word with one of some addresses is taken by nobody yet."""
        return any(not owner and word.address in addresses for word, owner in zip(self.words, self.owner, strict=True))

    def repeats(self, word: Word) -> bool:
        """Whether another word with its address is taken."""
        return any(owner and one.address == word.address for one, owner in zip(self.words, self.owner, strict=True))

    def word_functions(self) -> None:
        """F, S, T and the like: addresses that are functions by themselves."""
        control = self.control
        for i, word in enumerate(self.words if control.word_functions else ()):
            address = word.address
            if self.owner[i] or address in control.codes or address not in control.functions or self.repeats(word):
                continue
            self.owner[i] = control.functions[address].code
            self.hand_out(control.functions[address], i)

    def refuse_strangers(self, command: Action) -> None:
        """Where a block is one command: words that it does not take."""
        own = {command.head, *command.takes}
        for i, word in enumerate(self.words):
            if i in own:
                continue
            alike, before = sum(self.words[k].address == word.address for k in own), self.words[i - 1].span.line
            goes_on = f"line {before} ends with the mark * of a command that goes on" if before < word.span.line else ""
            if alike:
                times = "once" if alike == 1 else f"{alike} times"
                self.alarm(f"{command.code} takes {word.address} {times}: {word.rounded} is one too many", i, goes_on)
            what = command.what
            takes = what.takes if isinstance(what, Function) else [p.address for p in what.parameters() if not p.mark]
            whose = f", which takes {' '.join(takes).replace('*', '')}" if takes else ""
            self.alarm(f"{word.rounded} does not belong to the command {command.code}{whose}", i, goes_on)

    def modal_motion(self, functions: list[Function]) -> None:
        """Axis words that are left belong to the modal motion."""
        function = self.control.functions.get(self.modal.motion or "")
        if function is None or self.keyword or any(f.still or f.moves for f in functions):
            return
        if self.left_of(function.takes):
            self.hand_out(function, -1)

    def modal_call(self, functions: list[Function]) -> None:
        """A modal call of a cycle runs it in every block that positions and has no call of its own."""
        again, modal = self.control.calls_again, self.control.functions.get(self.modal.call or "")
        own = next((f for f in functions if f.group == "call"), None)
        if again is None or not (modal or (own and own.modal)):
            return
        if again(self.keyword, self.words) and modal and own is None:  # asked in any case: it refuses blocks
            self.hand_out(modal, -1)

    def refuse_still(self, functions: list[Function], index: int) -> None:
        """A word of a motion beside a function that moves nothing."""
        if still := next((f.code for f in functions if f.still), None):
            sentence = f"{still} stands in a block without motion, {self.words[index].rounded} does not belong to it"
            self.alarm(sentence, index, "write two blocks")

    def refuse_motion(self, functions: list[Function]) -> None:
        """Words of a function that moves beside one that does not."""
        moving = (a.takes for a in self.actions if a.takes and isinstance(a.what, Function) and a.what.moves)
        for moved in moving:
            self.refuse_still(functions, moved[0])

    def refuse_beside(self, code: str) -> None:
        """Another motion, or the call of a cycle, in the block of one that runs at once."""
        for _, what, _, head, takes in self.actions:
            if isinstance(what, Function) and (what.phase == "call" or what.moves and takes):
                index = takes[0] if takes else head
                sentence = f"{code} runs in a block of its own, {self.words[index].rounded} does not belong to it"
                self.alarm(sentence, index, "write two blocks")

    def refuse_leftovers(self, functions: list[Function]) -> None:
        refused, left = self.control.refused, [i for i, owner in enumerate(self.owner) if not owner]
        for i in left:
            word = self.words[i]
            if self.repeats(word):
                continue
            code = f"{word.address}{digits(word.value)}" if type(word.value) is float else ""
            if code in refused:
                self.alarm(refused[code], i)
            if word.address in refused:
                self.alarm(f"{word.address} is refused: {refused[word.address]}", i)
            if word.address in self.control.axes:
                self.refuse_still(functions, i)
                if self.modal.motion == "":
                    self.alarm(f"{word.rounded} has no motion: none is active", i, "write G0, G1, G2 or G3 in this block")
            actors = " ".join(dict.fromkeys(a.code for a in self.actions if a.phase == self.phases["motion"]))
            known = {*self.control.functions, *self.control.cycles}
            makers = next((a.code for a in self.actions if a.code not in known), "")
            told = f"what {makers} takes, the maker of the machine says: leave {word.rounded} out" if makers else ""
            self.alarm(word.untaken(actors), i, told)
        if left:
            self.alarm(f"{self.words[left[0]].address} is written twice in this block", left[0], "keep one of them")
