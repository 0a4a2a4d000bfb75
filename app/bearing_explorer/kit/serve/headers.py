"""Headers on every answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from tornado.httputil import HTTPHeaders
from tornado.web import OutputTransform

PERMISSIONS = (
    "accelerometer=(), autoplay=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), "
    "magnetometer=(), microphone=(), midi=(), payment=(), usb=(), xr-spatial-tracking=()"
)


class Headers(OutputTransform):
    """Headers on every answer.

    Bokeh makes functions from text (CustomJS), and Panel makes components from text. So scripts may
    be inline and use `eval`. No script, style, font or picture comes from another server.
    """

    frame_ancestors: ClassVar[tuple[str, ...]] = ("'self'",)

    def transform_first_chunk(
        self, status_code: int, headers: HTTPHeaders, chunk: bytes, finishing: bool
    ) -> tuple[int, HTTPHeaders, bytes]:
        del finishing
        headers["Content-Security-Policy"] = policy(self.frame_ancestors)
        headers["X-Content-Type-Options"] = "nosniff"
        headers["Referrer-Policy"] = "same-origin"
        headers["Permissions-Policy"] = PERMISSIONS
        headers["Cross-Origin-Opener-Policy"] = "same-origin"
        headers["Cross-Origin-Resource-Policy"] = "same-origin"
        if len(self.frame_ancestors) == 1:  # this header cannot name other sites
            headers["X-Frame-Options"] = "SAMEORIGIN"
        for name in ("Server", "Access-Control-Allow-Origin"):
            if name in headers:
                del headers[name]
        return status_code, headers, chunk


def policy(frame_ancestors: Sequence[str]) -> str:
    """Return rules on what the page may load and do, and on pages that may show it in a frame."""
    return "; ".join(
        [
            "default-src 'self'",
            "script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "font-src 'self' data:",
            "connect-src 'self' blob:",
            "worker-src 'self' blob:",
            "object-src 'none'",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors " + " ".join(frame_ancestors),
        ]
    )
