"""The server: hosts and messages that it allows, the packed data, private names of libraries."""
