"""The player: a page that needs nothing, in which a run is played, stepped through and looked at from all sides.

`payload` packs what the page needs of a run, `page` puts it into one HTML text; the page itself is `page.html`
with `page.css` and its scripts, in the order in which they build on each other: `data.js` (the run, unpacked),
`chain.js` (rotary axes that swing tool and part, as `machine` packs them), `shapes.js` (tools), `camera.js`, `strokes.js`,
`touches.js` (of a probe, whose part `part` packs, as it does all values); the part of a mill: `swept.js` (what a cutter
leaves, a tilted one in `leaning.js`), `heights.js` (the map), `walls.js` (where its walls stand), `carving.js` (at any place
of the run), `relief.js` and `shaded.js` (to look at), `shown_part.js`; of a lathe: `columns.js` and `turned.js` (its body),
`section.js`; of both, in depth: `space.js` (lines and bodies) and `bodies.js` (path, tool, what holds the blank); then
`picture.js`, `curve.js`, `listing.js`, `state.js`, `measure.js`, `conditions.js` and `stops.js` (where the playing stops),
`shades.js` (what colours say), `player.js`. `notebook.js` runs beside the frame. How programs are coloured is the editor's.
"""

from mnclab.show.player.page import Player, player

__all__ = ["Player", "player"]
