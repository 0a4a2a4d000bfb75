"""Which part of a bearing is damaged: what can be told from a signal, and no more."""
