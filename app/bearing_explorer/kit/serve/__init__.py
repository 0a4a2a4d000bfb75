"""The server: who may come in, the messages to the browser, private names of Panel and Bokeh."""
