"""Date, machine and measuring point of a recording, from the remarks and the name of its file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from datetime import datetime

from bearingcore.measured.files._facts import Finding

_DATE = re.compile(
    r"(?<!\d)(?:"
    r"(?P<year>(?:19|20)\d\d)(?:(?P<mark>[-_./ ])(?P<month>\d\d?)(?P=mark)(?P<day>\d\d?)"
    r"|(?P<joined_month>\d\d)(?P<joined_day>\d\d))"
    r"|(?P<first>\d\d?)(?P<between>[-./ ])(?P<mid>\d\d?|[A-Za-z]{3,9})(?P=between)"
    r"(?P<last_year>(?:19|20)?\d\d)"
    r")(?:[-_. T,;\t]+(?P<hour>[012]?\d)[-_.:h ]?(?P<minute>[0-5]\d)"
    r"(?:[-_.: ]?(?P<second>[0-5]\d))?(?:[.,]\d+)?(?:\s?(?P<am_pm>[AaPp])[Mm])?"
    r"(?!\d|[A-Za-z]{2}|[-/]\d))?(?!\d)"
)
"""A date with its time of day, if there is one: "12-Mar-24  09:14", "2004.02.12.10.32.39"."""

_MONTHS = {
    name: number % 12 + 1
    for names in (
        ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"),
        ("jän", "fév", "mrz", "avr", "mai", "juin", "juil", "aoû", "set", "okt", "nov", "dez"),
    )
    for number, name in enumerate(names)
}

_LABELLED = re.compile(
    r"(?:^|[;|,\t])[\s\"]*([^\W\d][\w ./()-]{0,30}?)[\s\"]*[:=;,\t][\s\",;]*"
    r"([^;|\t\"]*[^;|\t\"\s,])"
)
_OTHER_DATE = re.compile(r"(?i)export|calib|kalib|print|creat|modif|report|\bend|stop|due|version")
_MACHINES = {
    "machine", "maschine", "equipment", "asset", "anlage", "assetid", "assetname", "machineid",
    "machinename", "equipmentname", "equipmentid", "machinetag", "assettag",
}  # fmt: skip
_POINTS = {
    "point", "measpoint", "measurementpoint", "measuringpoint", "messpunkt", "messstelle", "mp",
    "pointname", "pointid", "location", "position", "sensorposition", "sensorlocation",
    "measurementlocation", "messort",
}  # fmt: skip
_TAG = re.compile(r"(?<![A-Za-z0-9])[A-Z]{1,4}-\d{2,4}[A-Z]?(?![A-Za-z0-9])")
_POINT_TAG = re.compile(r"(?<![A-Za-z0-9])(?:[MPF]?N?DE|M\d|P\d)-?[HVA]?(?![A-Za-z0-9])")
"""Usual forms of a machine's tag and of a measuring point in the name of a file."""


def time_in(text: str) -> datetime | None:
    """Return the date in a text, with its time of day if it has one; None for several dates.

    A date with an ambiguous month, such as 03/04/2024, does not count.

    >>> str(time_in("pump_2026-06-01.csv")), str(time_in("12-Mar-24  09:14:55"))
    ('2026-06-01 00:00:00', '2024-03-12 09:14:55')
    """
    dates = {date for match in _DATE.finditer(text) if (date := _date(match)) is not None}
    return dates.pop() if len(dates) == 1 else None


def _date(match: re.Match[str]) -> datetime | None:
    """Return the date and time of a match of `_DATE`; None if it is ambiguous or no date."""
    part = match.groupdict()
    hour, am_pm = int(part["hour"] or 0), (part["am_pm"] or "").lower()
    if am_pm:
        hour = hour % 12 + 12 * (am_pm == "p")
    if part["year"]:
        year, month = int(part["year"]), int(part["month"] or part["joined_month"])
        day = int(part["day"] or part["joined_day"])
    else:
        year = int(part["last_year"])
        month, day = _month_and_day(part, is_american=bool(am_pm))
        if part["mid"].isdigit() and year < 100 and not (part["between"] == "." and part["minute"]):
            return None  # it may be a version number
        year += 2000 * (year < 100)
    try:
        return datetime(year, month, day, hour, int(part["minute"] or 0), int(part["second"] or 0))
    except ValueError:
        return None


def _month_and_day(part: Mapping[str, str], *, is_american: bool) -> tuple[int, int]:
    """Return month and day before a year; month 0 if it is ambiguous."""
    day, word = int(part["first"]), part["mid"]
    if not word.isdigit():
        return _MONTHS.get(word[:3].lower(), 0), day
    month = int(word)
    if part["between"] == "/" and (is_american or month > 12):
        return day, month
    is_ambiguous = part["between"] == "/" and max(day, month) <= 12 and day != month
    return 0 if is_ambiguous else month, day


def remove_dates(line: str) -> str:
    """Return a line without its dates, because their numbers are no facts of the recording."""
    return _DATE.sub(lambda match: "" if _is_date(match) else match[0], line)


def _is_date(match: re.Match[str]) -> bool:
    """Return True if a match of `_DATE` is a date, even one with an ambiguous month."""
    return bool(_date(match)) or len(match["year"] or match["last_year"]) == 4


def named_dates(lines: Iterable[str]) -> dict[str, str]:
    """Return the dates in lines as text; the key of each is the words before it."""
    dates = {}
    for line in lines:
        for match in _DATE.finditer(line):
            if _is_date(match):
                labels = re.findall(r"[^\W\d][^;|\t:=,\"]*", line[: match.start()])
                dates[labels[-1].strip() if labels else "date"] = match[0].strip()
    return dates


def recording_time(lines: Iterable[str], file_name: str) -> Finding[datetime] | None:
    """Return the time of a recording from the remarks in its file, else from the file's name.

    Several dates in remarks count only if they are within a day.
    """
    lines = list(lines)
    times = {name: time_in(text) for name, text in named_dates(lines).items()}
    dates = {date: name for name, date in times.items() if date and not _OTHER_DATE.search(name)}
    if dates and (max(dates) - min(dates)).days < 1:
        first = min(dates)
        clock = [re.match(r"\W*(?:time|zeit)\W+(\d\d?):(\d\d)(?!\d)", ln, re.I) for ln in lines]
        if not (first.hour or first.minute) and (match := next(filter(None, clock), None)):
            first = first.replace(hour=int(match[1]) % 24, minute=int(match[2]))
        return Finding(first, f"“{dates[min(dates)]}” in the file")
    date = None if dates else time_in(file_name)
    return None if date is None else Finding(date, "the file's name", stated=False, strong=True)


def machine_or_point(kind: str, lines: Iterable[str], file_name: str) -> Finding[str] | None:
    """Return the name of a "machine" or measuring "point" from remarks or the file's name.

    The file's name may have a tag, such as P-101 for a machine or MDE-H for a point.
    """
    labels, tag = (_MACHINES, _TAG) if kind == "machine" else (_POINTS, _POINT_TAG)
    for line in lines:
        for part in re.split(r"[;|](?=[^;|]*[:=])", line):
            match = _LABELLED.match(part)
            if match and re.sub(r"[\W_]+", "", match[1]).lower() in labels:
                return Finding(" ".join(match[2].split()), f"“{match[1]}” in the file")
    match = tag.search(re.sub(r"\.\w+$", "", file_name))
    return match and Finding(match[0], "the file's name", stated=False, strong=True)
