"""Compartments, valves and arteries around the ventricles, and their coupling to the wall."""
