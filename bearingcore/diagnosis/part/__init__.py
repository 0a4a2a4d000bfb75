"""Which part of the bearing is damaged, if that can be told."""
