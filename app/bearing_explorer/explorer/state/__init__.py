"""State that a person sets: fields, scene, steps to undo, address, lessons. It draws nothing."""
