"""The same Newton step in other programs, each a script that runs in their own environment."""
