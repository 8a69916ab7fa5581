"""Q parameters that a cycle does not have; of one that is not built yet they are named beside its refusal.

Once a cycle is built, its own declaration counts and its entry here goes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from mnclab.machine.control import Control, Modal, Remark
from mnclab.machine.cycle import Cycle
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

#: Numbers of Q parameters by the cycles that take them.
_NUMBERS = {
    "CYCL DEF 21": "10 11 13",
    "CYCL DEF 23": "11 12 208",
    "CYCL DEF 24": "9 10 11 12 14 438",
    "CYCL DEF 25": "1 3 5 7 10 11 12 15 18 446 447 448",
    "CYCL DEF 276": "1 3 7 10 11 12 15 18 446 447 448",
    "CYCL DEF 270": "390 391 392 393 394",
    "CYCL DEF 275": "12 200 201 202 203 204 206 207 215 219 338 351 366 368 369 385 436 439",
    "CYCL DEF 27, CYCL DEF 39": "1 3 6 10 11 12 16 17",
    "CYCL DEF 28": "1 3 6 10 11 12 16 17 20 21",
    "CYCL DEF 29": "1 3 6 10 11 12 16 17 20",
    "TCH PROBE 450": "409 S409 410",
    "TCH PROBE 451": "253 320 380 406 407 408 411 412 413 414 415 416 417 418 419 420 421 422 423 431 432",
    "TCH PROBE 452": "253 320 380 407 408 411 412 413 414 415 416 417 418 419 420 421 422 423 432",
    "TCH PROBE 1420": "260 309 320 372 1100 1101 1102 1103 1104 1105 1106 1107 1108 1120 1121 1125 1126",
    "TCH PROBE 1410": "260 309 320 372 1100 1101 1102 1103 1104 1105 1120 1121 1125 1126",
    "TCH PROBE 1411": "260 309 320 325 423 1100 1101 1102 1103 1104 1105 1115 1116 1117 1119 1120 1121 1125 1126",
    "TCH PROBE 400": "260 261 263 264 265 266 267 272 301 305 307 320",
    "TCH PROBE 401": "260 261 268 269 270 271 305 307 337 402",
    "TCH PROBE 402": "260 261 268 269 270 271 301 305 307 313 314 315 320 337 402",
    "TCH PROBE 403": "260 261 263 264 265 266 267 272 301 303 305 312 320 337 380",
    "TCH PROBE 404": "305 307",
    "TCH PROBE 405": "247 260 261 262 301 320 321 322 325 337",
    "TCH PROBE 420": "260 261 263 264 265 266 267 272 281 301 320",
    "TCH PROBE 421": "247 260 261 262 273 274 275 276 279 280 281 301 309 320 325 330 365 423 498 531",
    "TCH PROBE 422": "247 260 261 262 273 274 277 278 279 280 281 301 309 320 325 330 365 423 498 531",
    "TCH PROBE 423, TCH PROBE 424": "260 261 273 274 279 280 281 282 283 284 285 286 287 301 309 320 330",
    "TCH PROBE 425": "260 261 272 281 288 289 301 309 310 311 320 328 329 330",
    "TCH PROBE 426": "260 261 263 264 265 266 272 281 288 289 309 311 320 330",
    "TCH PROBE 427": "260 261 263 264 267 272 281 288 289 309 320 330 498 531",
    "TCH PROBE 430": "260 261 262 273 274 279 280 281 288 289 291 292 293 309 330",
    "TCH PROBE 431": "260 263 264 265 266 281 294 295 296 297 298 320",
    "TCH PROBE 408": "260 261 272 301 303 305 311 320 321 322 333 381 382 383 384 405",
    "TCH PROBE 409": "260 261 272 303 305 311 320 321 322 333 381 382 383 384 405",
    "TCH PROBE 410, TCH PROBE 411": "260 261 301 303 305 320 321 322 323 324 331 332 333 381 382 383 384",
    "TCH PROBE 412, TCH PROBE 413": ("247 260 261 262 301 303 305 320 321 322 325 331 332 333 365 381 382 383 384 423"),
    "TCH PROBE 414": "260 261 263 264 296 297 301 303 304 305 320 326 327 331 332 333 381 382 383 384",
    "TCH PROBE 415": "260 261 263 264 301 303 304 305 308 320 326 327 331 332 333 381 382 383 384",
    "TCH PROBE 416": "260 261 262 273 274 291 292 293 303 305 320 331 332 333 381 382 383 384",
    "TCH PROBE 417": "260 263 264 294 303 305 320 333",
    "TCH PROBE 418": "260 261 268 269 270 271 303 305 316 317 318 319 331 332 333 381 382 383 384",
    "TCH PROBE 460": "301 320 380 407 423 433 434 455",
    "TCH PROBE 461": "434",
    "TCH PROBE 462": "320 380 407 423",
    "TCH PROBE 463": "301 320 380 407 423",
    "TCH PROBE 441": "396 397 399 400",
    "TCH PROBE 480": "260",
    "TCH PROBE 484": "536",
    "TCH PROBE 481, TCH PROBE 482, TCH PROBE 483": "260 340 341",
}
PARAMETERS = {
    code: frozenset(f"Q{number}" for number in numbers.split())
    for codes, numbers in _NUMBERS.items()
    for code in codes.split(", ")
}


#: A line `Q1=-9` without a number below a definition is one of its lines (3.1): they carry no numbers of their own.
_BELONGS = "a line Q… without a block number belongs to the definition above it: number it to assign a variable"


def strange_parameters(built: Mapping[str, type[Cycle]]) -> Callable[[Control, Modal, str, list[Word]], list[Remark]]:
    """Refuses parameters that a cycle does not have; of a cycle that is not built they are only named."""

    def check(control: Control, modal: Modal, code: str, words: list[Word]) -> list[Remark]:
        if code not in built:
            strange = enumerate(words if code in PARAMETERS else ())
            return [(k, f"{code} has no parameter {w.address}", "") for k, w in strange if w.address not in PARAMETERS[code]]
        taken = {address for p in built[code].parameters() for address in (p.address, *p.aliases)}
        for word in words:
            if word.address[0] == "Q" and word.address not in taken:
                message = f"{word} has no meaning in this block ({code} does not take {word.address})"
                raise Alarm(message, word.span, hint=_BELONGS)
        return []

    return check
