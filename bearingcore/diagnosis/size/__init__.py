"""How large a defect is, if that can be told."""
