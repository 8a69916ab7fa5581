"""The turned part, and what the tools of a lathe meet, on the half section: coordinates (z, r), mm."""
