"""The table of fields: `python -m tests.fields > assets/docs/FIELDS.md`."""

from bearingcore.fields import FIELDS


def as_markdown() -> str:
    """All fields as a table for the documents, one row each, in the order of the page."""
    lines = [
        "# Fields",
        "",
        "All numbers of a scene, printed from `bearingcore.fields.FIELDS`. `Scene.replace` and "
        "sweeps use the name, with a value in SI units; links use the name with the unit of the "
        "page. `cage_angle` is not a number of a scene: links hold it, and functions take it, as "
        "in `equilibrium(scene, cage_angles)`.",
        "",
        "| name | of | symbol | SI unit | in links | unit there | meaning |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for field in FIELDS:
        cells = (
            f"`{field.full_name}`",
            field.part or "page",
            field.symbol,
            field.unit,
            f"`{field.key}`" if field.group else "",
            field.shown_unit or "1",
            field.meaning,
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(as_markdown())
