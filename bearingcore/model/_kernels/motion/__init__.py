"""Motion of both rings: equations of motion, fixed steps, and their tangent."""
