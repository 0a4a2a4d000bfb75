"""Motion of both rings: equations of motion, steps fixed and adaptive, and their tangent."""
