"""The fixed cycles (CYCL DEF), a file a chapter of the manual."""
