"""Results in the forms of other programs: InferenceData of ArviZ, tidy tables, the model space of PEtab Select."""
