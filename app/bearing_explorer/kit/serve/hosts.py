"""Names under which browsers may reach the page, and origins whose pages may connect to it.

Browsers let any page open a websocket to any server, and a foreign name can lead to this machine
(DNS rebinding). So the server checks both host and origin. Tornado does not: from 6.6 on it accepts
any websocket whose host and origin agree, or whose browser says that it is of the same site.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any
from urllib.parse import urlsplit

_PORTS = {"http": 80, "https": 443}
_NAME = re.compile(r"[\w.-]+|\[[0-9a-f:.]+\]", re.ASCII)


def origins_of(text: str) -> set[str]:
    """Return the origins that `[scheme://]name[:port]` stands for, as browsers write them.

    Without a scheme, both are returned. ValueError for text of another form.
    """
    parts = urlsplit(text if "://" in text else f"//{text}")
    port, name = parts.port, parts.netloc.lower().removesuffix(f":{parts.port}")
    beyond = parts.path.strip("/") or parts.query or parts.fragment
    if parts.scheme not in ("", *_PORTS) or not _NAME.fullmatch(name) or beyond:
        raise ValueError(f"{text!r} is no host")
    schemes = [parts.scheme] if parts.scheme else _PORTS
    return {
        f"{scheme}://{name}" + (f":{port}" if port not in (None, _PORTS[scheme]) else "")
        for scheme in schemes
    }


class AllowedHosts:
    """The hosts of a server: this machine, the address that it listens on, and the named ones.

    The server itself speaks http. A page that comes by https comes through a proxy, which has to be
    named.
    """

    def __init__(self, port: int, address: str, named: Iterable[str] = ()) -> None:
        host = f"[{address}]" if ":" in address else address
        names = {"localhost", "127.0.0.1", "[::1]", *([host] if host else ())}
        here = [origins_of(f"http://{name}:{port}") for name in names]
        self._origins = set().union(*here, *map(origins_of, named))
        self._names = {urlsplit(origin).hostname for origin in self._origins}

    def allow_page(self, request: Any) -> bool:
        """Return True if a request names an allowed host; proxies may leave its port out."""
        try:
            return urlsplit(f"//{request.host}").hostname in self._names
        except ValueError:
            return False

    def allow_origin(self, origin: str) -> bool:
        """Return True if a page of this origin may connect."""
        return origin.lower() in self._origins

    def allow_socket(self, request: Any) -> bool:
        """Return True if a request's host and origin are allowed; only programs name no origin."""
        named = [request.headers.get(name) for name in ("Origin", "Sec-Websocket-Origin")]
        origins = [origin for origin in named if origin is not None]
        return self.allow_page(request) and all(map(self.allow_origin, origins))
