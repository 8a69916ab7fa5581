"""Side by side: two paths and how far they are apart; strategies, what they cut and how hard the tool works."""
