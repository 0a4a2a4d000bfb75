"""From a measured signal to the machine: which part is damaged, and how large the defect is."""
