"""Parts of figures that only views of scenes use."""
