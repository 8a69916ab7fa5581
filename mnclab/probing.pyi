"""What measured points are: circle(points), and how sure that is."""

from mnclab.machining.probing.fits import angle as angle
from mnclab.machining.probing.fits import centre_of_four as centre_of_four
from mnclab.machining.probing.fits import circle as circle
from mnclab.machining.probing.fits import corner as corner
from mnclab.machining.probing.fits import line as line
from mnclab.machining.probing.fits import off_the_ball as off_the_ball
from mnclab.machining.probing.fits import plane as plane
from mnclab.machining.probing.fits import rectangle as rectangle
from mnclab.machining.probing.fits import reduced as reduced
from mnclab.machining.probing.fits import sphere as sphere
from mnclab.machining.probing.fits import uncertainty as uncertainty
from mnclab.machining.probing.fits import width as width
from mnclab.machining.probing.found import Circle as Circle
from mnclab.machining.probing.found import Line as Line
from mnclab.machining.probing.found import Plane as Plane
from mnclab.machining.probing.found import Point as Point
from mnclab.machining.probing.found import Rectangle as Rectangle
from mnclab.machining.probing.found import Sphere as Sphere
from mnclab.machining.probing.found import Width as Width
from mnclab.machining.probing.found import axes_on as axes_on
from mnclab.machining.probing.found import spatial_angles as spatial_angles
