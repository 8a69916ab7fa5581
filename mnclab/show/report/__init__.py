"""A run as a report to hand in or file, and the sheets that a shop takes to the machine, as HTML or PDF."""

from mnclab.show.report.gathering import report as report
