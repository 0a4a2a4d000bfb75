"""Numbers for columns, edges and statuses, which compiled code and the rest of the model share."""

PATH_COLUMNS = (
    "center",
    "turn_ratio",
    "half_extent",
    "depth",
    "angle_from_edge_to_floor",
    "edge",
    "raceway_radius",
    "ball_radius",
    "table_start",
    "table_size",
    "row",
)
"""Columns of the table of defects; the last is the bearing's row, or EVERY_ROW."""
CENTER, TURN_RATIO, HALF_EXTENT, DEPTH, FLOOR_ANGLE, EDGE = 0, 1, 2, 3, 4, 5
RACEWAY_RADIUS, BALL_RADIUS, TABLE_START, TABLE_SIZE, ROW = 6, 7, 8, 9, 10

PUBLISHED, CHORD, EXACT, INNER_EXACT, TABLE = 0, 1, 2, 3, 4
"""Values of the column `edge`."""

EVERY_ROW = -1
"""Entry of the column `row` for a defect that the balls of all rows meet."""

CONVERGED, NOTHING_TOUCHES, FREE_DIRECTION, NOT_CARRIED, NOT_CONVERGED = 0, 1, 2, 3, 4
"""Statuses of a cage angle; their sentences are in `equilibrium`."""

OPEN, REFUSED = -1, 5
"""Further statuses of a map's point: not solved yet; defects that are impossible together."""

TOO_MANY = 6
"""Status of all cage angles if there are more of them than the caller allows."""

BEYOND = 7
"""Status of a balance of loads outside the geometry of the bearing: see `Contacts.room`."""
