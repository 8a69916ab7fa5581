"""The names at the front door."""

from mnclab.comparison.strategies import compare as compare
from mnclab.comparison.tool_sets import tool_sets as tool_sets
from mnclab.comparison.turning_schemes import compare as compare_turning
from mnclab.controls.choice import Help as Help
from mnclab.controls.choice import help as help
from mnclab.controls.choice import modern as modern
from mnclab.controls.choice import read as read
from mnclab.controls.choice import renumber as renumber
from mnclab.controls.choice import run as run
from mnclab.controls.cycle_steps import steps as steps
from mnclab.controls.proving import diff as diff
from mnclab.controls.proving import prove as prove
from mnclab.controls.survey import check as check
from mnclab.controls.survey import run_many as run_many
from mnclab.design.model import Design as Design
from mnclab.design.model import TurnedDesign as TurnedDesign
from mnclab.lab.editor import editor as editor
from mnclab.geometry.kinematics import Axis as Axis
from mnclab.geometry.kinematics import Kinematics as Kinematics
from mnclab.lab.forms import compensation_panel as compensation_panel
from mnclab.lab.forms import form as form
from mnclab.lab.forms import panel as panel
from mnclab.lab.forms import pocket_panel as pocket_panel
from mnclab.lab.forms import profile_panel as profile_panel
from mnclab.lab.magic import load_ipython_extension as load_ipython_extension
from mnclab.learning.exercise import exercise as exercise
from mnclab.learning.exercise import exercises as exercises
from mnclab.learning.marking import mark as mark
from mnclab.learning.progress import progress as progress
from mnclab.machine.probe import Probe as Probe
from mnclab.machine.probe import Setter as Setter
from mnclab.machine.setup import Datum as Datum
from mnclab.machine.setup import Setup as Setup
from mnclab.path.limits import Limits as Limits
from mnclab.path.machines import machines as machines
from mnclab.path.profile import Profile as Profile
from mnclab.path.profile.stopwatch import fit_limits as fit_limits
from mnclab.path.tool import Tool as Tool
from mnclab.path.tool import Wear as Wear
from mnclab.path.toolpath import Kind as Kind
from mnclab.path.toolpath import RULE_NAMES as RULE_NAMES
from mnclab.path.toolpath import Toolpath as Toolpath
from mnclab.runs.run import Run as Run
from mnclab.show.plot.over_time import plot_profiles as plot_profiles
from mnclab.show.plot.side_by_side import plot_runs as plot_runs
from mnclab.text.alarm import Alarm as Alarm
from mnclab.text.program import Program as Program
from mnclab.workpiece.blank import box as box
from mnclab.workpiece.blank import cylinder as cylinder
from mnclab.workpiece.collision import Collision as Collision
from mnclab.workpiece.removal import Removal as Removal
from mnclab.workpiece.workpiece import Workpiece as Workpiece

from . import area as area
from . import blank as blank
from . import design as design
from . import part as part
from . import probing as probing
from . import schemes as schemes
from . import strategies as strategies
from .controls import Controls

__version__: str
controls: Controls

__all__ = ["compare_turning"]  # names that are others there; all others are exported by their "as"
