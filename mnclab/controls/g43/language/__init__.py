"""The functions of the ISO mill, by what they do."""
