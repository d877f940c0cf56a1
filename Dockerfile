# docker build -t turgor . && docker run --rm -v "$PWD:/work" turgor run job.toml
FROM python:3.12-slim-bookworm
# The CAD kernel loads these two libraries.
RUN apt-get update \
    && apt-get install -y --no-install-recommends libgl1=1.6.* libglu1-mesa=9.0.* \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /opt/turgor
COPY pyproject.toml README.md LICENSE ./
COPY release/readme.py release/readme.py
COPY requirements/run.lock requirements/run.lock
COPY src src
COPY examples examples
RUN pip install --no-cache-dir -r requirements/run.lock && pip install --no-cache-dir --no-deps .
RUN useradd --create-home --uid 1000 turgor
USER 1000
WORKDIR /work
ENTRYPOINT ["turgor"]
