"""Runs plydrape on damaged and strange input, and sees whether it keeps its promises."""
