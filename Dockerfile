# The explorer in a slim image: installed in a first stage, run by a user without rights in a second.
FROM python:3.12-slim AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE ./
COPY bearingcore bearingcore
COPY app app
COPY assets assets
RUN python -m venv /opt/explorer && /opt/explorer/bin/pip install --no-cache-dir .

FROM python:3.12-slim
RUN useradd --create-home --uid 1000 explorer
COPY --from=build --chown=explorer /opt/explorer /opt/explorer
ENV PATH=/opt/explorer/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    NUMBA_CACHE_DIR=/opt/explorer/kernels
USER explorer
WORKDIR /home/explorer
# Compiled here, so that the first user does not wait. A host whose processor is another kind than
# the builder's compiles once more, and says so as it starts.
RUN python -c "import bearingcore; bearingcore.warm()"
EXPOSE 5006
HEALTHCHECK --interval=30s --timeout=5s --start-period=60s \
    CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://localhost:5006/liveness', timeout=4)"]
# Behind a name of its own it also needs --allow-websocket-origin: see assets/docs/OPERATING.md.
ENTRYPOINT ["bearing-explorer", "--address", "0.0.0.0", "--port", "5006", "--no-browser"]
