"""Boxes for numbers, with a picture that follows: a form from the declaration of a cycle, panels from a template or a run.

Number boxes, not sliders, unless sliders are asked for: a slider has no name for a screen reader and fires a false change
when it appears. ipywidgets is imported inside the functions that use it.
"""

from mnclab.lab.forms.cycle_form import form as form
from mnclab.lab.forms.panels import compensation_panel as compensation_panel
from mnclab.lab.forms.panels import panel as panel
from mnclab.lab.forms.panels import pocket_panel as pocket_panel
from mnclab.lab.forms.panels import profile_panel as profile_panel
