"""What tests ask of a page of the player."""

import base64
import json
import re
import zlib

#: Wait until it has begun. `wait_for_function` asks again by `eval`, which the page does not allow.
BEGUN = "async () => { while (!window.player) await new Promise(requestAnimationFrame); }"


def hidden_scripts(page):
    """The scripts that the page's first one unpacks, as bytes."""
    return [inflated(text) for text in re.findall(r'id="code">([^<]*)<', page)]


def inflated(text):
    return zlib.decompress(base64.b64decode(text))


def unpack(text):
    """Header and columns of a payload, the columns as lists of whole numbers."""
    data = inflated(text)
    size = int.from_bytes(data[:4], "little")
    header, at, columns = json.loads(data[4 : 4 + size]), 4 + size, []
    for count in header["columns"]:
        column, before = [], 0
        for _ in range(count):
            value = shift = 0
            while True:
                byte, at = data[at], at + 1
                value |= (byte & 127) << shift
                shift += 7
                if byte < 128:
                    break
            before += -(value + 1) // 2 if value % 2 else value // 2
            column.append(before)
        columns.append(column)
    assert at == len(data)
    return header, columns
