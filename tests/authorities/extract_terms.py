"""The manuals' own terms, copied from a catalogue: writes `terms.toml` of each control, and terms.json beside this file.

    python3 tests/authorities/extract_terms.py CATALOGUE SEEDS

CATALOGUE holds a YAML file for each part of a manual, SEEDS the texts of the manuals. A term stands in its manual, but for
case, spaces and letters that look alike; those that do not are printed. The tests read only terms.json.
"""

import json
import re
import sys
import unicodedata
from pathlib import Path

import yaml

HERE = Path(__file__).parent
HOUSE = HERE.parents[1] / "mnclab"
FOLDERS = {"mnc": "mnc", "jnc-t01": "jnc_t01", "nc-31": "nc_31", "g43-control": "g43", "tnc-620": "tnc_620"}
#: What a manual says in other words than its catalogue.
SAID = {
    ("g43-control", "M6"): "функция смены инструмента",
    ("g43-control", "comment"): "",
    ("g43-control", "other chapters"): "",
    ("jnc-t01", "G72"): "",
    ("mnc", "words"): "Таблица 1.1",
    ("mnc", "block execution"): "кадр",
    ("mnc", "settings"): "",
    ("mnc", "power-on state"): "При включении системы ЧПУ",
    ("mnc", "axes"): "Основные положения",
    ("mnc", "coordinate transformations"): "Преобразование системы координат",
    ("mnc", "G41"): "Коррекция на радиус инструмента слева",
    ("mnc", "G42"): "Коррекция на радиус инструмента справа",
    ("mnc", "M5"): "",
    ("mnc", "probe table"): "",
    ("mnc", "probe touch"): "точка касания; срабатывание щупа",
    ("mnc", "tolerance check"): "предельные отклонения",
    ("mnc", "meas_prot"): "протокол измерений; meas_prot",
    ("nc-31", "frame"): "кадр",
    ("nc-31", "*"): "признак",
    ("nc-31", "~"): "признак; ускоренный ход",
    ("nc-31", "X"): "Диаметр получаемой поверхности",
    ("nc-31", "Z"): "Конечная координата прохода",
    ("nc-31", "F"): "Подача",
    ("nc-31", "P"): "Параметры Р1, Р2, Р3",
    **{("nc-31", each): "" for each in "NSMG"},
    ("nc-31", "machine parameters"): "параметр станка",
    ("nc-31", "G67"):
        "Контроль останова в конечной точке движения, синхронизация начала движения с нулевой меткой шпинделя и блокировка",
    ("nc-31", "G25"): "",
    ("nc-31", "semi-finish pass"): "черновая с получистовым (зачистным) проходом",
    ("nc-31", "closed zone strokes"): "закрытая зона",
    ("nc-31", "productivity ranking"): "Оценка основных схем черновых переходов по производительности",
    ("nc-31", "scheme by zone"): "Типовые схемы переходов",
    ("nc-31", "thread zone rule"): "шаг более 2 мм",
    ("tnc-620", "CYCL DEF 220"): "MODEL POLAR / MODEL CERC",
    ("tnc-620", "CYCL DEF 221"): "MODEL PUNCTE LINIAR / MODEL CARTEZIAN / MODEL LINII",
    ("tnc-620", "engraving layout"): "Gravarea",
    ("tnc-620", "CfgThreadSpindle"): "CfgThreadSpindle",
    ("tnc-620", "TT geometry"): "Rularea ciclului",
    ("tnc-620", "tilted working plane"):
        "Poziționarea într-un sistem de coordonate înclinat; Combinarea ciclurilor; Procedura de lucru cu Ciclul 19",
}  # fmt: skip
ALIKE = str.maketrans("аеорсухкмтвнşţ«»„”“–—−", 'aeopcyxkmtbhșț"""""---')


def alike(text: str) -> str:
    """A text without case, marks of a page, and differences that are not seen."""
    text = unicodedata.normalize("NFC", re.sub(r"[*`\u00ad]", "", text).casefold())
    return re.sub(r"\s+", " ", text.translate(ALIKE)).strip()


def term_of(control: str, code: str, title: str) -> str:
    """The term, without the numbers of the cycle behind it and what the catalogue says in its own words."""
    own = SAID.get((control, code))
    title = re.sub(r"\s*\((?:[Cc]iclul?|Cycle) [^)]*\)", "", title) if own is None else own
    return "" if title.startswith("(") else title.strip()


def stands(part: str, manual: str) -> bool:
    """Whether words stand in a manual, maybe in another case or number."""
    stems = (re.escape(word if len(word) < 5 else word[:-2]) for word in part.split())
    return part in manual or bool(re.search(r"\b" + r"\w* ".join(stems), manual))


def main(catalogue: Path, seeds: Path) -> None:
    """Write the files and print what stands in no manual."""
    entries = []
    for file in sorted(catalogue.glob("*.yaml"), key=lambda file: (file.stem in ("tnc620-index", "tnc620-klartext"), file.stem)):
        part = yaml.safe_load(file.read_text("utf-8"))
        kept = (each for each in part["entries"] if each.get("title_source"))
        entries += [(part["control"], file.stem, part["source"], each) for each in kept]
    found: dict[str, dict[str, dict[str, list[str]]]] = {}
    expected, missing, manuals = [], [], {}
    for control, stem, source, each in entries:
        code, kind = str(each["code"]), "turning technology" if stem == "turning-technology" else each["kind"]
        term = term_of(control, code, each["title_source"])
        manual = manuals.get(source) or manuals.setdefault(source, alike((seeds / source).read_text("utf-8")))
        parts = [term] if alike(term) in manual else re.split(r" / |[;:,.()/]", term)
        parts = [re.sub("№[2-6]$", "№1-№6", part) for part in parts]  # six in one row
        missing += [f"{control} {code}: {part.strip()}" for part in parts if not stands(alike(part), manual)]
        if each["title_source"].startswith("("):
            continue
        row = found.setdefault(control, {}).setdefault(kind, {}).setdefault(code, [each["title"], term])
        if alike(term) not in alike(" ".join(row[1:])):
            row.append(term)
        if term:
            expected.append([control.removesuffix("-control"), code, term])
    for control, kinds in found.items():
        text = ["# The manual's own terms: code = [title, term, another term in the same manual]", ""]
        for kind, rows in kinds.items():
            lines = (f"{json.dumps(code)} = {json.dumps(row, ensure_ascii=False)}" for code, row in rows.items())
            text += [f"[{json.dumps(kind) if ' ' in kind else kind}]", *lines, ""]
        (HOUSE / "controls" / FOLDERS[control] / "terms.toml").write_text("\n".join(text), "utf-8")
    lines = ",\n".join(json.dumps(each, ensure_ascii=False) for each in expected)
    (HERE / "catalogue" / "terms.json").write_text(f"[\n{lines}\n]\n", "utf-8")
    print(f"{len(expected)} terms; not in their manual:", *missing, sep="\n  ")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
