"""Areas, pockets, studs and faces, milled."""
