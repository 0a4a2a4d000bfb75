"""The views of the scene, one file each. `kit.views.base.View` describes a view."""
