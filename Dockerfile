# The explorer in a slim image: installed in a first stage, run by a user without rights in a second.
FROM python:3.12.12-slim-bookworm AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE ./
COPY bearingcore bearingcore
COPY app app
COPY assets assets
RUN python -m venv /opt/explorer && /opt/explorer/bin/pip install --no-cache-dir ".[files]"
# Compiled here, so that the first user does not wait. A host whose processor is another kind than
# the builder's compiles at each start, and says so.
RUN NUMBA_CACHE_DIR=/opt/explorer/kernels /opt/explorer/bin/python -c "import bearingcore; bearingcore.warm()"

FROM python:3.12.12-slim-bookworm
RUN useradd --create-home --uid 1000 explorer
# Program and kernels are root's: whoever gets in as the user can change neither.
COPY --from=build /opt/explorer /opt/explorer
ENV PATH=/opt/explorer/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    NUMBA_CACHE_DIR=/opt/explorer/kernels
USER explorer
WORKDIR /home/explorer
EXPOSE 5006
HEALTHCHECK --interval=30s --timeout=10s --start-period=60s \
    CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://localhost:5006/liveness', timeout=8)"]
# Behind a name of its own it also needs --allow-websocket-origin: see assets/docs/OPERATING.md.
ENTRYPOINT ["bearing-explorer", "--address", "0.0.0.0", "--port", "5006", "--no-browser"]
