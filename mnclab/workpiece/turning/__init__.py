"""What a lathe leaves: the silhouettes of its tools taken away from the half section of the bar."""
