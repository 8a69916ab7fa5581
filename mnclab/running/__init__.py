"""What happens while a program runs: words are handed out, cycles bound, steps performed, loops and calls followed."""
