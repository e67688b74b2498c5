"""The study's tables and figures, from results to what is printed."""
