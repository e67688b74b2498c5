"""What a study may say: its settings, cases and numbers in SI units, validated before anything runs."""
