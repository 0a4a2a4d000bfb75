"""Messages to a browser."""

import pytest
from bearing_explorer.serve.live import counted_once, one_message, send_at_once
from bokeh.document import Document
from bokeh.document.models import DocumentModelManager
from bokeh.models import ColumnDataSource, Row, Spacer

from tests.helpers.loops import run


def test_without_a_session_there_is_nothing_to_send_to() -> None:
    assert send_at_once(None) == 0
    changes: list[int] = []
    run(one_message(None, lambda: changes.append(1)))
    assert changes == [1]


def test_models_are_counted_once_and_only_where_some_came(monkeypatch: pytest.MonkeyPatch) -> None:
    document, row, source = Document(), Row(), ColumnDataSource({"x": []})
    row.tags = [source]
    document.add_root(row)
    counts: list[int] = []
    count = DocumentModelManager.recompute

    def counting(self: DocumentModelManager) -> None:
        counts.append(1)
        count(self)

    monkeypatch.setattr(DocumentModelManager, "recompute", counting)
    for _ in range(2):
        with counted_once(document):
            for number in range(3):
                with document.models.freeze():  # as HoloViews does for each figure
                    source.data = {"x": [number]}
        assert counts == []
    with counted_once(document):
        row.children = [Spacer()]
        row.children = [*row.children, Spacer()]
    assert counts == [1]
    assert all(child in set(document.models) for child in row.children)
    row.children = []
    assert len(counts) == 2, "and from then on as ever"
    with counted_once(None):
        pass
