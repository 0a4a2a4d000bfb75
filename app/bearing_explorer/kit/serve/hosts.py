"""Names under which browsers may reach the page, and origins whose pages may connect to it.

Browsers let any page open a websocket to any server, and a name of a stranger can lead to this
machine (DNS rebinding): so the server asks for both names. Tornado does not: from 6.6 on it takes
any websocket whose two names agree, or whose browser says that it is of the same site.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple
from urllib.parse import urlsplit

from bokeh.server.util import match_host
from tornado.httputil import HTTPServerRequest

_PORTS = {"http": 80, "https": 443}
_NAME = re.compile(r"[\w.*-]+|[0-9a-f:.]+", re.ASCII)


class Host(NamedTuple):
    """A host, or a pattern of hosts with stars; no scheme stands for both, no port for theirs."""

    scheme: str
    name: str
    port: int | None


def read_host(text: str) -> Host:
    """Read `[scheme://]name[:port]`; ValueError where it is no such thing."""
    parts = urlsplit(text if "://" in text else f"//{text}")
    name = parts.hostname or ""
    beyond = parts.path.strip("/") or parts.query or parts.fragment or "@" in parts.netloc
    if parts.scheme not in ("", *_PORTS) or not _NAME.fullmatch(name) or beyond:
        raise ValueError(f"{text!r} is no host")
    return Host(parts.scheme, name, parts.port)


@dataclass(frozen=True)
class AllowedHosts:
    """The hosts of a server.

    Attributes
    ----------
    port
        that it listens on.
    address
        that it listens on; the names of this machine itself are always allowed.
    named
        others, such as the name of a proxy.
    """

    port: int
    address: str = "localhost"
    named: tuple[Host, ...] = ()

    def allow_page(self, request: HTTPServerRequest) -> bool:
        """Return True if a request names an allowed host. Proxies often leave its port out."""
        try:
            name = read_host(request.host).name
        except ValueError:
            return False
        return self._is_local(name) or any(match_host(name, host.name) for host in self.named)

    def allow_origin(self, origin: str) -> bool:
        """Return True if a page of this origin may connect.

        This server speaks http: a page that came by https came through a proxy, whose name has been
        allowed, or from elsewhere.
        """
        try:
            scheme, name, port = read_host(origin)
        except ValueError:
            return False
        if scheme == "":
            return False
        port = port or _PORTS[scheme]
        if scheme == "http" and port == self.port and self._is_local(name):
            return True
        return any(
            host.scheme in ("", scheme)
            and match_host(name, host.name)
            and (host.name == "*" or port == (host.port or _PORTS[scheme]))
            for host in self.named
        )

    def allow_socket(self, request: HTTPServerRequest) -> bool:
        """Return True if both the host and the origin of a request are allowed.

        Programs name no origin, browsers always do.
        """
        origins = [request.headers.get(name) for name in ("Origin", "Sec-Websocket-Origin")]
        return self.allow_page(request) and all(
            origin is None or self.allow_origin(origin) for origin in origins
        )

    def _is_local(self, name: str) -> bool:
        return name in ("localhost", "127.0.0.1", "::1", self.address.lower())
