"""Which registration follows a heart: the library's and ours on synthetic images of a known motion."""
